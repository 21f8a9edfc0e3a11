// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

std::vector<Labels> labels_of_mesh(const TriangleMesh& mesh) {
    const Surface surface = surface_of(mesh);
    const NoisySurface noisy{surface.stars, surface.positions,
                             std::vector<float>(surface.positions.size(), 1)};
    return labels_of(noisy, part_ranges(noisy.stars, surface.parts));
}

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Vector3d& by) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::Translation3d(by)));
}

TEST(Labels, ShareALatticeWithPartsThatAreTooSmallForOne) {
    const TriangleMesh large = ball_of_marching_cubes(5),
                       small = moved(ball_of_marching_cubes(0.5), {20, 0, 0});
    EXPECT_TRUE(labels_of_mesh(small).empty());
    const std::vector<Labels> labels = labels_of_mesh(shapes::merged(large, small));
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_EQ(labels[0].ranges.size(), 2U);
    EXPECT_EQ(labels[0].vertices.size(), large.positions.size() + small.positions.size());
}

TEST(Labels, ShareASoftLattice) {
    const TriangleMesh large = averaged_ball(8), small = moved(averaged_ball(4), {20, 0, 0}),
                       sphere = moved(shapes::geodesic_sphere(9), {0, 20, 0});
    const std::vector<Labels> labels =
        labels_of_mesh(shapes::merged(shapes::merged(large, small), sphere));
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_TRUE(labels[0].lattice.is_soft);
    EXPECT_EQ(labels[0].vertices.size(), large.positions.size() + small.positions.size());
}

TEST(Labels, OfOtherLatticesAndOtherPartsAreApart) {
    const TriangleMesh ball = ball_of_faces(6), other = moved(ball_of_faces(5), {20.3, 0, 0}),
                       sphere = moved(shapes::geodesic_sphere(9), {0, 20, 0});
    const std::vector<Labels> labels =
        labels_of_mesh(shapes::merged(shapes::merged(ball, other), sphere));
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0].vertices.size(), ball.positions.size()) << "the largest part first";
    EXPECT_EQ(labels[1].vertices.size(), other.positions.size());
}

TEST(Labels, HaveStairs) {
    EXPECT_TRUE(labels_of_mesh(cube()).empty());
    const Labels ball = labels_of_mesh(ball_of_faces(6)).at(0);
    EXPECT_EQ(ball.has_stairs, (std::array<bool, 3>{true, true, true}));
    EXPECT_NEAR(ball.height() * mean_edge_length(ball_of_faces(6)), 1, 1e-6);
    EXPECT_EQ(std::count(ball.flat_sides.begin(), ball.flat_sides.end(), 0),
              static_cast<std::ptrdiff_t>(ball.flat_sides.size()));
}

/// Returns a ball of cells on a grid that is twice as fine.
TriangleMesh resampled(double radius) {
    return shapes::voxels(-20, 20, [&](const Eigen::Vector3i& at) {
        return in_ball(radius)((at.cast<double>() / 2).array().floor().matrix().cast<int>());
    });
}

TEST(Labels, OnAFinerGridHaveTheirOwnCells) {
    const Labels ball = labels_of_mesh(resampled(6)).at(0);
    EXPECT_EQ(ball.subdivision, 2);
    EXPECT_NEAR(ball.height() * mean_edge_length(resampled(6)), 2, 1e-6);
}

TEST(Labels, KnowFlatSidesFromTerraces) {
    const TriangleMesh disc = shapes::voxels(-12, 12, [](const Eigen::Vector3i& at) {
        return std::hypot(at[0] + 0.3, at[1] - 0.2) < 10 && std::abs(at[2]) < 3;
    });
    const Labels labels = labels_of_mesh(disc).at(0);
    EXPECT_EQ(labels.has_stairs, (std::array<bool, 3>{true, true, false}));
    const auto on_caps = std::count_if(labels.flat_sides.begin(), labels.flat_sides.end(),
                                       [](std::uint8_t sides) { return (sides & 4U) != 0; });
    EXPECT_GT(on_caps, 500) << "both caps have more than 300 cells";
    const auto on_sides = std::count_if(labels.flat_sides.begin(), labels.flat_sides.end(),
                                        [](std::uint8_t sides) { return (sides & 3U) != 0; });
    EXPECT_EQ(on_sides, 0) << "a round side has terraces";
}

}  // namespace
}  // namespace tracked_mcf
