// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/unevenness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// Returns the sides of the voxels inside a ball around the origin, two triangles for each.
TriangleMesh ball_of_voxels(int radius) {
    const auto is_inside = [&](const std::array<int, 3>& voxel) {
        double square = 0;
        for (const int x : voxel) square += (x + 0.5) * (x + 0.5);
        return square < radius * radius;
    };
    TriangleMesh mesh;
    std::array<int, 3> at{};
    for (at[0] = -radius; at[0] < radius; ++at[0]) {
        for (at[1] = -radius; at[1] < radius; ++at[1]) {
            for (at[2] = -radius; at[2] < radius; ++at[2]) {
                if (!is_inside(at)) continue;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    for (const int side : {0, 1}) {
                        std::array<int, 3> beside = at;
                        beside[axis] += 2 * side - 1;
                        if (is_inside(beside)) continue;
                        Eigen::Vector3d corner(at[0], at[1], at[2]);
                        corner[Eigen::Index(axis)] += side;
                        const Eigen::Vector3d u = Eigen::Vector3d::Unit(Eigen::Index(axis + 1) % 3),
                                              v = Eigen::Vector3d::Unit(Eigen::Index(axis + 2) % 3);
                        const auto first = static_cast<std::int32_t>(mesh.positions.size());
                        for (const Eigen::Vector3d& step :
                             {Eigen::Vector3d(0, 0, 0), u, Eigen::Vector3d(u + v), v}) {
                            mesh.positions.emplace_back(corner + step);
                        }
                        mesh.triangles.push_back({first, first + 1, first + 2});
                        mesh.triangles.push_back({first, first + 2, first + 3});
                    }
                }
            }
        }
    }
    return mesh;
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
