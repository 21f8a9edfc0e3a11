// SPDX-License-Identifier: GPL-3.0-or-later
// A detail size that follows the local edge length.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/plan/densities.h"
#include "tests/support/plans.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

// All triangles of a tube of radius 1 are alike.
TriangleMesh coarse_tube() {
    return shapes::tube(48, 16, 1);
}
TriangleMesh fine_tube() {
    return shapes::transformed(shapes::tube(96, 32, 1),
                               Eigen::Affine3d(Eigen::Translation3d(3, 0, 0)));
}

constexpr double kDelta = 0.01;

FlowParameters following_edges() {
    FlowParameters p = parameters(6, kDelta, 1);
    p.absolute = true;
    p.boundary = BoundaryCondition::Free;
    p.local_detail_size = true;
    return p;
}

/// Checks that each vertex from `first` on is as far from an axis along z as after one step of δ.
void expect_radius(const TriangleMesh& mesh, std::size_t first, std::size_t last, double axis_x,
                   double delta) {
    const double expected = 1 / (1 + delta);
    for (std::size_t i = first; i < last; ++i) {
        const Eigen::Vector3d& p = mesh.positions[i];
        // A tenth of the smallest shrinkage here.
        ASSERT_NEAR(std::hypot(p[0] - axis_x, p[1]), expected, 0.1 * (1 - expected));
    }
}

TEST(LocalDetailSize, IsProportionalToTheEdgeLength) {
    const TriangleMesh coarse = coarse_tube(), fine = fine_tube();
    const TriangleMesh both = shapes::merged(coarse, fine);
    const double mean = mean_edge_length(both);
    const TriangleMesh after = evolved(both, following_edges());
    const std::size_t first_fine = coarse.positions.size();
    expect_radius(after, 0, first_fine, 0, kDelta * std::pow(mean_edge_length(coarse) / mean, 2));
    expect_radius(after, first_fine, after.positions.size(), 3,
                  kDelta * std::pow(mean_edge_length(fine) / mean, 2));
}

TEST(LocalDetailSize, IsTheDetailSizeWhereAllEdgesAreAlike) {
    FlowParameters p = following_edges();
    const TriangleMesh following = evolved(fine_tube(), p);
    p.local_detail_size = false;
    EXPECT_LT(distance(evolved(fine_tube(), p), following), 1e-6);
}

TEST(LocalDetailSize, GivesTheMeanCurvatureOfThatSize) {
    TriangleMesh mesh = shapes::merged(coarse_tube(), fine_tube());
    const double mean = mean_edge_length(mesh);
    FlowParameters p = following_edges();
    p.quality = Quality::MeanCurvature;
    p.solver = Solver::Grid;  // the mesh measures it at one size, whatever the detail size
    p.tolerance = 1e-6;
    const std::vector<double> following = evolve(mesh, p).quality;
    p.local_detail_size = false;
    const auto expect_equal = [&](const TriangleMesh& tube, std::size_t first, std::size_t last) {
        p.step_size = kDelta * std::pow(mean_edge_length(tube) / mean, 2);
        TriangleMesh both = shapes::merged(coarse_tube(), fine_tube());
        const std::vector<double> expected = evolve(both, p).quality;
        for (std::size_t i = first; i < last; ++i) ASSERT_NEAR(following[i], expected[i], 1e-4);
    };
    const std::size_t first_fine = coarse_tube().positions.size();
    expect_equal(coarse_tube(), 0, first_fine);
    expect_equal(fine_tube(), first_fine, following.size());
}

TEST(LocalDetailSize, IsATenthToTenTimesTheDetailSize) {
    const TriangleMesh coarse = shapes::square(1), fine = shapes::square(60);
    const TriangleMesh mesh = shapes::merged(
        coarse, shapes::transformed(fine, Eigen::Affine3d(Eigen::Translation3d(0, 0, 1))));
    ASSERT_GT(mean_edge_length(coarse), 2 * kLargestDetailRatio * mean_edge_length(mesh));
    FlowParameters p = following_edges();
    p.depth = 4;
    const Flow flow(plan_of(mesh, p));
    const std::vector<float>& densities = flow.stepper().elements().densities;
    const auto [least, most] = std::minmax_element(densities.begin(), densities.end());
    EXPECT_NEAR(*least, 1 / (kLargestDetailRatio * kLargestDetailRatio), 1e-8);
    EXPECT_GT(*most, 1);
    // The limit holds where the step is largest.
    p.step_size = 1e9;
    EXPECT_NEAR(Flow(plan_of(mesh, p)).stepper().size().in_cells, 1e5 * double{*least}, 1);
}

}  // namespace
}  // namespace tracked_mcf
