// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/parts.h"

#include <gtest/gtest.h>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TEST(Parts, MakeTheSurfaceThatTheyWereMergedFrom) {
    const TriangleMesh first = shapes::geodesic_sphere(3), second = cube();
    const NoisySurface surface = surface_of_mesh(shapes::merged(first, second));
    std::vector<std::int32_t> numbers(first.positions.size(), 0);
    numbers.resize(surface.positions.size(), 1);
    const std::vector<PartRange> parts = part_ranges(surface.stars, numbers);
    ASSERT_EQ(parts.size(), 2U);
    const SurfaceParts cubes = parts_from(surface, {parts[1]});
    EXPECT_EQ(cubes.surface.stars.count(), static_cast<std::int32_t>(second.positions.size()));
    EXPECT_EQ(cubes.surface.stars.triangles.size(), second.triangles.size());
    EXPECT_EQ(cubes.vertices.front(), static_cast<std::int32_t>(first.positions.size()));
    EXPECT_EQ(cubes.surface.positions.back(), surface.positions.back());
    EXPECT_EQ(cubes.surface.fidelity.size(), cubes.vertices.size());
    EXPECT_EQ(cubes.ranges[0].end_triangle, whole_of(cubes.surface).end_triangle);
    const SurfaceParts both = parts_from(surface, parts);
    EXPECT_EQ(both.surface.positions, surface.positions);
    EXPECT_NEAR(mean_edge_of(both.surface), 1, 1e-12) << "lengths are in edges";
}

}  // namespace
}  // namespace tracked_mcf
