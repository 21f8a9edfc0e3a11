// SPDX-License-Identifier: GPL-3.0-or-later
// The flow commutes with translations, scalings and quarter turns.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Flow parameters, and a mesh for them.
struct Case {
    const char* name;
    TriangleMesh mesh;
    FlowParameters parameters;
};

std::vector<Case> cases() {
    const TriangleMesh closed = shapes::bumpy_sphere(20), open = bumpy_cap(20);
    std::vector<Case> result;
    for (const Preserve preserve : {Preserve::None, Preserve::Area, Preserve::Volume}) {
        for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
            Case of{"closed", closed, parameters(5, 1e-4, 5)};
            of.parameters.preserve = preserve;
            of.parameters.flow = flow;
            result.push_back(of);
        }
    }
    for (const Method method : {Method::Converged, Method::Paper}) {
        for (const auto boundary : {BoundaryCondition::Locked, BoundaryCondition::Free}) {
            Case of{"open", open, parameters(5, 1e-4, 5)};
            of.parameters.boundary = boundary;
            of.parameters.method = method;
            result.push_back(of);
        }
    }
    // Rounding may change the number of iterations, and so the result by the tolerance.
    for (Case& of : result) of.parameters.tolerance = 1e-6;
    return result;
}

TEST(Symmetry, CommutesWithTranslation) {
    const Eigen::Affine3d shift(Eigen::Translation3d(3.7, -11.3, 5.1));
    for (const Case& of : cases()) {
        EXPECT_LT(distance(evolved(shapes::transformed(of.mesh, shift), of.parameters),
                           shapes::transformed(evolved(of.mesh, of.parameters), shift)),
                  1e-6)
            << of.name;
    }
}

TEST(Symmetry, CommutesWithScaling) {
    for (const Case& of : cases()) {
        const TriangleMesh unscaled = evolved(of.mesh, of.parameters);
        for (const double scale : {1e-9, 1e12}) {
            const Eigen::Affine3d scaling(Eigen::Scaling(scale));
            const TriangleMesh expected = shapes::transformed(unscaled, scaling);
            FlowParameters scaled = of.parameters;
            scaled.step_size *= scale * scale;
            EXPECT_LT(distance(evolved(shapes::transformed(of.mesh, scaling), scaled), expected),
                      1e-6 * scale)
                << of.name;
        }
    }
}

TEST(Symmetry, FlowFarFromTheOriginIsThatAtTheOrigin) {
    // A georeferenced scan in single precision has a resolution of 1/16 of a unit, here 1/200 of an
    // edge. The mesh at the origin, in double precision, has exactly the same shape.
    const Eigen::Vector3d far(500000, 4500000, 1000);
    TriangleMesh there =
        shapes::transformed(shapes::bumpy_sphere(20), Eigen::Affine3d(Eigen::Scaling(100.0)));
    TriangleMesh here = there;
    for (std::size_t i = 0; i < there.positions.size(); ++i) {
        there.positions[i] = (there.positions[i] + far).cast<float>().cast<double>();
        here.positions[i] = there.positions[i] - far;
    }
    const FlowParameters p = scaled_to(here, parameters(5, 1e-4, 5));
    const TriangleMesh after = evolved(there, p);
    TriangleMesh expected = evolved(here, p);
    for (auto& position : expected.positions) position += far;
    EXPECT_LT(distance(after, expected), 1e-4);
    EXPECT_GT(distance(after, there), 1);
}

/// Returns the distance between turning the evolved mesh and evolving the turned mesh. Both have
/// the same equations except for rounding, but the smoother processes them in another order. So the
/// distance is the solver's error and decreases as the solver converges.
double effect_of_a_quarter_turn(int axis, const FlowParameters& p) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Eigen::Vector3d around = Eigen::Vector3d::Unit(axis);
    return distance(evolved(turned(mesh, kQuarterTurn, around), p),
                    turned(evolved(mesh, p), kQuarterTurn, around));
}

TEST(Symmetry, CommutesWithQuarterTurnsInTheLimitOfManyCycles) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto difference = [&](int cycles) {
            FlowParameters p = parameters(4, 1e-3, 1);
            p.method = Method::Paper;
            p.cycles = cycles;
            return effect_of_a_quarter_turn(axis, p);
        };
        const double of_one_cycle = difference(1);
        EXPECT_LT(difference(10), 0.2 * of_one_cycle);
        EXPECT_LT(difference(100), 1e-6);  // rounding of single precision
    }
}

}  // namespace
}  // namespace tracked_mcf
