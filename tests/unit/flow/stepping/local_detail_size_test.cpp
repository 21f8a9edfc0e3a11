// SPDX-License-Identifier: GPL-3.0-or-later
// A detail size that follows the local edge length.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "filter_tracked_mcf/core/flow/plan/densities.h"
#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
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

TEST(LocalDetailSize, IsATenthToTenTimesTheDetailSize) {
    const TriangleMesh coarse = shapes::square(1), fine = shapes::square(60);
    const TriangleMesh mesh = shapes::merged(
        coarse, shapes::transformed(fine, Eigen::Affine3d(Eigen::Translation3d(0, 0, 1))));
    ASSERT_GT(mean_edge_length(coarse), 2 * kLargestDetailRatio * mean_edge_length(mesh));
    FlowParameters p = following_edges();
    const MeshPlan plan = mesh_plan_of(mesh, {}, p);
    const auto [least, most] = std::minmax_element(plan.densities.begin(), plan.densities.end());
    EXPECT_NEAR(*least, 1 / (kLargestDetailRatio * kLargestDetailRatio), 1e-8);
    EXPECT_GT(*most, 1);
}

}  // namespace
}  // namespace tracked_mcf
