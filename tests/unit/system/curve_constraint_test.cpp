// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/curve_constraint.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/support/cotangent_flow.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TrackedElements build(const TriangleMesh& mesh, int depth,
                      BoundaryCondition boundary = BoundaryCondition::Locked) {
    return build_tracked_elements(Domain(mesh, boundary), enclosing_grid(mesh, depth),
                                  Cubature::ThreePoints);
}

TEST(CurveConstraint, BalancesTheSurfaceAtTheStart) {
    // The free boundary of a plane pulls with -δ ∫ ∇B · ∇X. The constraint cancels this force.
    const TriangleMesh patch = turned(shapes::square(9), 0.4, {1, -1, 3});
    const TrackedElements elements = build(patch, 4);
    const Coefficients rest = Coefficients::Zero(elements.finest().unknown_count(), 3);
    ElementSystems systems;
    assemble_elements(elements, rest, {0, 1}, systems);
    const auto largest_force = [&] {
        Coefficients force = rest;
        for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
            for (int corner = 0; corner < 8; ++corner) {
                for (int axis = 0; axis < 3; ++axis) {
                    force(elements.finest().unknowns[element][corner], axis) +=
                        systems.right_sides[element].entry[axis][corner];
                }
            }
        }
        return force.cwiseAbs().maxCoeff();
    };
    EXPECT_GT(largest_force(), 0.1);
    const CurveConstraint curve(elements);
    curve.add(rest, curve.zero_multipliers(), 1, systems);
    EXPECT_LT(largest_force(), 1e-5);
}

TEST(CurveConstraint, MultipliersTakeOverThePenaltyForce) {
    // The penalty pulls a translated surface back. After the update the multipliers add the same
    // force.
    const TriangleMesh patch = shapes::square(9);
    const TrackedElements elements = build(patch, 4);
    Coefficients moved = Coefficients::Zero(elements.finest().unknown_count(), 3);
    moved.col(2).setConstant(0.01);
    const CurveConstraint curve(elements);
    const auto force = [&](const std::vector<Eigen::Vector3d>& multipliers) {
        ElementSystems systems;
        assemble_elements(elements, moved, {1, 0}, systems);
        curve.add(moved, multipliers, 1, systems);
        double sum = 0;
        for (const ElementVector& of_element : systems.right_sides) {
            for (const float entry : of_element.entry[2]) sum += entry;
        }
        return sum;
    };
    const double of_penalty = force(curve.zero_multipliers());
    EXPECT_LT(of_penalty, 0);
    EXPECT_NEAR(force(curve.updated(curve.zero_multipliers(), moved)), 2 * of_penalty,
                1e-4 * std::abs(of_penalty));
}

TEST(CurveConstraint, SurfaceBesideTheBoundaryFollowsTheCotangentFlow) {
    // Compares triangles at the boundary with the cotangent flow of the mesh with fixed boundary
    // vertices.
    const TriangleMesh cap = bumpy_cap(60, 0);
    CotangentFlow reference(cap, 1e-4, BoundaryCondition::Locked);
    for (int step = 0; step < 5; ++step) reference.step();
    const Domain domain(cap, BoundaryCondition::Locked);
    const auto largest_error_near_boundary = [&](BoundaryCondition boundary) {
        FlowParameters p = parameters(5, 1e-4, 5);
        p.solver = Solver::Grid;
        p.boundary = boundary;
        const TriangleMesh after = evolved(cap, p);
        double largest = 0;
        for (const Triangle& t : cap.triangles) {
            const bool near = std::any_of(t.begin(), t.end(), [&](auto vertex) {
                return domain.constrained_vertices()[vertex] != 0;
            });
            if (!near) continue;
            for (const std::int32_t vertex : t) {
                const auto error = after.positions[vertex] - reference.mesh().positions[vertex];
                largest = std::max(largest, error.norm());
            }
        }
        return largest;
    };
    const double locked = largest_error_near_boundary(BoundaryCondition::Locked);
    EXPECT_LT(locked, 0.25 * largest_error_near_boundary(BoundaryCondition::LockedCells));
    EXPECT_LT(locked, 0.25 * largest_error_near_boundary(BoundaryCondition::Free));
}

}  // namespace
}  // namespace tracked_mcf
