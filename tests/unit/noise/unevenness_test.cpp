// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/unevenness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TriangleMesh ball_of_voxels(int radius) {
    return shapes::voxels(-radius, radius, [&](const Eigen::Vector3i& at) {
        return (at.cast<double>().array() + 0.5).matrix().norm() < radius;
    });
}

// The mean of the sides 1, 1 and √2 is an edge.
TEST(Stairs, OfVoxelsAreAsHighAsAVoxelAndCertain) {
    const Stairs stairs = stairs_of(surface_of_mesh(ball_of_voxels(12)));
    EXPECT_NEAR(stairs.height, 3 / (2 + std::sqrt(2.0)), 1e-6);
    EXPECT_TRUE(stairs.are_certain);
}

TEST(Stairs, AreNotFoundOnCubesSpheresAndNoise) {
    for (const TriangleMesh& mesh :
         {cube(), shapes::geodesic_sphere(12), with_noise(ball_of_voxels(12), 0.2)}) {
        EXPECT_EQ(stairs_of(surface_of_mesh(mesh)).height, 0);
    }
}

TEST(Unevenness, OfVoxelsIsTheirStairs) {
    const NoisySurface surface = surface_of_mesh(ball_of_voxels(12));
    const Unevenness found = unevenness_of(surface, {});
    EXPECT_EQ(found.stairs, stairs_of(surface).height);
    EXPECT_EQ(found.width, 0);
}

}  // namespace
}  // namespace tracked_mcf
