// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/flatness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

Flatness flatness_of(const TriangleMesh& mesh, double rounding = 1e-12) {
    const NoisySurface surface = surface_of_mesh(mesh);
    return flatness_of(surface.stars, surface.positions, rounding);
}

std::int64_t flat_vertices(const Flatness& flatness) {
    return std::count(flatness.share.begin(), flatness.share.end(), 1);
}

// The edges of a cube have 12 x 19 + 8 vertices. All edges between them bend, but for the diagonals
// beside some corners.
TEST(Flatness, OfACubeIsThatOfItsSides) {
    const TriangleMesh mesh = cube();
    const Flatness flatness = flatness_of(mesh);
    EXPECT_EQ(flat_vertices(flatness),
              static_cast<std::int64_t>(mesh.positions.size()) - (12 * 19 + 8));
    EXPECT_LT(flatness.edges, 0.1);
}

TEST(Flatness, OfFewTrianglesIsThatOfTheirDiagonals) {
    const Flatness flatness = flatness_of(shapes::box(1, {1, 2, 3}));
    EXPECT_EQ(flat_vertices(flatness), 0);
    EXPECT_DOUBLE_EQ(flatness.edges, 6.0 / 18);
}

TEST(Flatness, IsNoneWithNoiseAndOnSpheres) {
    for (const TriangleMesh& mesh : {with_noise(cube(), 0.05), shapes::geodesic_sphere(10)}) {
        const Flatness flatness = flatness_of(mesh);
        EXPECT_EQ(flat_vertices(flatness), 0);
        EXPECT_LT(flatness.edges, 0.01);
    }
}

TEST(Flatness, IsUnknownWhereRoundingBendsTheSurface) {
    const TriangleMesh noisy = with_noise(cube(), 1e-4);
    EXPECT_GT(flat_vertices(flatness_of(noisy, 5e-4)), 1000);
    EXPECT_EQ(flatness_of(noisy, 1).edges, 0);
    EXPECT_EQ(flat_vertices(flatness_of(noisy, 1)), 0);
}

}  // namespace
}  // namespace tracked_mcf
