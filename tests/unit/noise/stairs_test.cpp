// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/stairs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// Over 50 x 50 cells.
TriangleMesh high_hills() {
    return raster(
        50, [](double x, double y) { return 10 * std::sin(0.12 * x) * std::sin(0.1 * y + 0.3); });
}

TEST(Stairs, OfARasterAreAsHighAsAUnit) {
    const TriangleMesh mesh = high_hills();
    const Stairs stairs = stairs_of(surface_of_mesh(mesh));
    EXPECT_NEAR(stairs.height * mean_edge_length(mesh), 1, 0.3);
    EXPECT_TRUE(stairs.are_certain);
}

// The longest edges are those of the base, and the walls are the farthest planes.
TEST(Stairs, OfARasterMayHaveWallsAndABase) {
    TriangleMesh mesh = high_hills();
    for (Eigen::Vector3d& p : mesh.positions) {
        if (p.x() == 0 || p.y() == 0 || p.x() == 50 || p.y() == 50) p.z() = -30;
    }
    const auto corner = static_cast<std::int32_t>(mesh.positions.size());
    for (const double x : {0.0, 50.0}) {
        for (const double y : {0.0, 50.0}) mesh.positions.emplace_back(x, y, -30);
    }
    mesh.triangles.push_back({corner, corner + 1, corner + 3});
    mesh.triangles.push_back({corner, corner + 3, corner + 2});
    const Stairs stairs = stairs_of(surface_of_mesh(mesh));
    EXPECT_GT(stairs.height, 0);
    EXPECT_LT(stairs.height * mean_edge_length(mesh), 2);
}

TEST(Stairs, AreOnlyThoseOfReliefs) {
    for (const TriangleMesh& mesh :
         {cube(), shapes::geodesic_sphere(12), with_noise(high_hills(), 0.2), ball_of_faces(12)}) {
        EXPECT_EQ(stairs_of(surface_of_mesh(mesh)).height, 0);
    }
}

}  // namespace
}  // namespace tracked_mcf
