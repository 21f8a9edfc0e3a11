// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

Stars stars_of_triangles(const TriangleMesh& mesh) {
    return Stars({mesh.triangles.begin(), mesh.triangles.end()},
                 static_cast<std::int32_t>(mesh.positions.size()));
}

TEST(Stars, ListEachTriangleOnceAtEachOfItsVertices) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    const Stars stars = stars_of_triangles(mesh);
    std::vector<int> seen(3 * mesh.triangles.size(), 0);
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
            EXPECT_EQ(mesh.triangles[triangle][corner], vertex);
            ++seen[3 * triangle + corner];
        });
    }
    EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
}

TEST(Stars, NeighboursAreTheOtherCornersOfTheTriangles) {
    const TriangleMesh mesh = shapes::annulus(7, 3, 1, 2);
    const Stars stars = stars_of_triangles(mesh);
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        std::set<std::int32_t> others;
        for (const Triangle& t : mesh.triangles) {
            if (std::find(t.begin(), t.end(), vertex) != t.end()) others.insert(t.begin(), t.end());
        }
        others.erase(vertex);
        const auto begin = stars.neighbours.begin();
        EXPECT_TRUE(std::equal(others.begin(), others.end(), begin + stars.neighbour_begin[vertex],
                               begin + stars.neighbour_begin[vertex + 1]))
            << vertex;
    }
}

TEST(Stars, TheRimIsThatOfARing) {
    const TriangleMesh mesh = shapes::annulus(12, 3, 1, 2);
    const Stars stars = stars_of_triangles(mesh);
    EXPECT_EQ(std::accumulate(stars.rim_sides.begin(), stars.rim_sides.end(), 0), 2 * 12);
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        const double radius = mesh.positions[vertex].norm();
        const bool on_rim = std::abs(radius - 1) < 1e-9 || std::abs(radius - 2) < 1e-9;
        EXPECT_EQ(stars.on_rim[vertex] != 0, on_rim) << vertex;
        int neighbours = 0;
        for_each_rim_neighbour(stars, vertex, [&](std::int32_t) { ++neighbours; });
        EXPECT_EQ(neighbours, on_rim ? 2 : 0) << vertex;
    }
    EXPECT_TRUE(stars_of_triangles(shapes::geodesic_sphere(3)).on_rim.empty());
}

TEST(Diffuse, KeepsTheSumAndConstants) {
    const Stars stars = stars_of_triangles(shapes::bumpy_sphere(6));
    std::vector<float> values(static_cast<std::size_t>(stars.count()), 0.75F);
    diffuse(stars, 20, values);
    EXPECT_EQ(values, std::vector<float>(values.size(), 0.75F));
    values.assign(values.size(), 0);
    values[5] = 1;
    diffuse(stars, 20, values);
    EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0), 1, 1e-5);
    EXPECT_LT(*std::max_element(values.begin(), values.end()), 0.2F);
    EXPECT_GE(*std::min_element(values.begin(), values.end()), 0);
}

}  // namespace
}  // namespace tracked_mcf
