// SPDX-License-Identifier: GPL-3.0-or-later
// A flow with a locked boundary converges to a minimal surface.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/minimal_surfaces.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {
namespace {

using Eigen::Vector3d;

constexpr auto kLocked = BoundaryCondition::Locked;
constexpr auto kFree = BoundaryCondition::Free;

/// Returns the mesh after the flow has brought it to rest.
TriangleMesh at_rest(TriangleMesh mesh, Method method = Method::Converged, double step_size = 16) {
    FlowParameters parameters;
    parameters.order = 1;
    parameters.method = method;
    parameters.depth = method == Method::Paper ? 5 : 0;
    parameters.step_size = step_size;
    parameters.iterations = 40;
    EXPECT_EQ(evolve(mesh, parameters).stop, Stop::None);
    return mesh;
}

/// Returns the orders of an error between meshes of half the edge length each.
std::vector<double> orders(const std::vector<double>& errors) {
    std::vector<double> result;
    for (std::size_t i = 1; i < errors.size(); ++i) {
        result.push_back(std::log2(errors[i - 1] / errors[i]));
        std::printf("%.2e to %.2e: order %.2f\n", errors[i - 1], errors[i], result.back());
    }
    return result;
}

TEST(CatenoidFlow, ConvergesWithTheSquareOfTheEdge) {
    const Catenoid catenoid(0.8);
    std::vector<double> errors;
    for (const int refinement : {1, 2, 4}) {
        const TriangleMesh tube = shapes::tube(60 * refinement, 12 * refinement, catenoid.height());
        errors.push_back(catenoid.rms_offset(at_rest(tube).positions));
    }
    for (const double order : orders(errors)) EXPECT_GE(order, 1.9);
}

TEST(CatenoidFlow, LockedCellsCostThePapersMethodMuch) {
    // The cells at the rings keep the cylinder's shape (section 5.5).
    const Catenoid catenoid(0.8);
    const TriangleMesh tube = shapes::tube(120, 24, catenoid.height());
    const double ours = catenoid.rms_offset(at_rest(tube).positions);
    const double papers = catenoid.rms_offset(at_rest(tube, Method::Paper).positions);
    std::printf("ours %.2e, the paper's %.2e\n", ours, papers);
    EXPECT_GE(papers, 10 * ours);
    EXPECT_LE(papers, 0.1);
}

TEST(CatenoidFlow, EndsAtTheSameSurfaceForAnyStepSize) {
    const TriangleMesh tube = shapes::tube(120, 24, Catenoid(0.8).height());
    const TriangleMesh usual = at_rest(tube);
    for (const double step_size : {0.1, 1.0, 100.0}) {
        const double distance =
            normal_distance(at_rest(tube, Method::Converged, step_size), usual).rms;
        std::printf("step size %g: %.1e\n", step_size, distance);
        EXPECT_LT(distance, 2e-5) << step_size;
    }
}

TEST(FlowOnTheMesh, ReachesTheCatenoidInAnyNumberOfStepsWithoutAFold) {
    const Catenoid catenoid(0.8);
    const TriangleMesh tube = shapes::tube(96, 40, catenoid.height());
    const double chords = 1 - std::cos(std::acos(-1.0) / 96);
    for (const auto& [step_size, steps] : {std::pair{1.0, 20}, {0.01, 200}, {0.002, 1000}}) {
        FlowParameters parameters;
        parameters.order = 1;
        parameters.step_size = step_size;
        parameters.iterations = steps;
        TriangleMesh after = tube;
        EXPECT_EQ(evolve(after, parameters).stop, Stop::None);
        const double offset = catenoid.rms_offset(after.positions);
        std::printf("%d steps of %g: %.2e\n", steps, step_size, offset);
        EXPECT_LT(offset, 2 * chords) << steps;
        for (const Triangle& t : tube.triangles) {
            EXPECT_GT(twice_vector_area(after, t).dot(twice_vector_area(tube, t)), 0) << steps;
        }
    }
}

TEST(EnneperFlow, ConvergesWithNearlyTheSquareOfTheEdge) {
    const Enneper surface(0.8);
    std::vector<double> errors;
    for (const int refinement : {1, 2, 4}) {
        const TriangleMesh moved = at_rest(surface.cone(60 * refinement, 10 * refinement));
        double squares = 0;
        for (const Vector3d& position : moved.positions) {
            squares += std::pow(surface.distance(position), 2);
        }
        errors.push_back(std::sqrt(squares / static_cast<double>(moved.positions.size())));
    }
    // The triangles at the apex become thinner, as more of them meet there.
    for (const double order : orders(errors)) EXPECT_GE(order, 1.6);
}

/// Boundary, flow, method, and whether the plane is oblique to the grid.
using FlatCase = std::tuple<BoundaryCondition, FlowKind, Method, bool>;

class FlatFlow : public testing::TestWithParam<FlatCase> {
protected:
    FlowParameters parameters() const {
        FlowParameters parameters;
        parameters.order = 1;
        parameters.depth = 5;
        parameters.step_size = 0.01;
        parameters.iterations = 10;
        std::tie(parameters.boundary, parameters.flow, parameters.method, std::ignore) = GetParam();
        return parameters;
    }
    static Eigen::Affine3d placement() {
        const Eigen::Affine3d shift(Eigen::Translation3d(0.3, -0.2, 0.1));
        const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, 0.5).normalized());
        return std::get<bool>(GetParam()) ? turn * shift : shift;
    }
};

TEST_P(FlatFlow, StaysInItsPlane) {
    const TriangleMesh before = shapes::transformed(shapes::annulus(120, 20, 0.4, 1), placement());
    TriangleMesh after = before;
    evolve(after, parameters());
    const Vector3d normal = placement().linear().col(2);
    double off = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        off = std::max(off, std::abs((after.positions[i] - before.positions[i]).dot(normal)));
    }
    const double moved = worst_distance(after, before);
    std::printf("off the plane by %.1e, moved by %.1e\n", off, moved);
    EXPECT_LT(off, 1e-6 + 5e-5 * moved);  // rounding of single precision
    if (parameters().boundary == kFree) {
        EXPECT_LT(surface_area(after), 0.9 * surface_area(before));
    } else {
        EXPECT_LT(moved, 1e-5);
    }
}

std::string name_of(const testing::TestParamInfo<FlatCase>& test) {
    const auto [boundary, flow, method, is_oblique] = test.param;
    return std::string(boundary == kLocked ? "Locked" : "Free") +
           (flow == FlowKind::Conformalized ? "_Conformalized" : "_MeanCurvature") +
           (method == Method::Converged ? "_Converged" : "_Paper") +
           (is_oblique ? "_Oblique" : "_Aligned");
}

INSTANTIATE_TEST_SUITE_P(AnAnnulus, FlatFlow,
                         testing::Combine(testing::Values(kLocked, kFree),
                                          testing::Values(FlowKind::MeanCurvature,
                                                          FlowKind::Conformalized),
                                          testing::Values(Method::Converged), testing::Bool()),
                         name_of);

INSTANTIATE_TEST_SUITE_P(AnAnnulusByThePapersMethod, FlatFlow,
                         testing::Combine(testing::Values(kLocked, kFree),
                                          testing::Values(FlowKind::MeanCurvature),
                                          testing::Values(Method::Paper), testing::Bool()),
                         name_of);

}  // namespace
}  // namespace tracked_mcf
