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

/// Returns V - E + F.
std::int64_t euler_characteristic(const TriangleMesh& mesh) {
    const Stars stars = stars_of_triangles(mesh);
    return stars.count() - stars.edge_count() + static_cast<std::int64_t>(stars.triangles.size());
}

TEST(Stars, EulerCharacteristics) {
    EXPECT_EQ(euler_characteristic(shapes::geodesic_sphere(5)), 2);
    EXPECT_EQ(euler_characteristic(shapes::torus(12, 7, 1, 0.3)), 0);
    EXPECT_EQ(euler_characteristic(shapes::square(4)), 1);
    EXPECT_EQ(euler_characteristic(shapes::moebius_band(20, 3)), 0);
}

std::int64_t count_rim_sides(const TriangleMesh& mesh) {
    const Stars stars = stars_of_triangles(mesh);
    return std::count(stars.rim_sides.begin(), stars.rim_sides.end(), 1);
}

TEST(Stars, TheRimHasTheSidesOfOneTriangle) {
    EXPECT_EQ(count_rim_sides(shapes::geodesic_sphere(3)), 0);
    EXPECT_EQ(count_rim_sides(shapes::square(5)), 20);
    EXPECT_EQ(count_rim_sides(shapes::moebius_band(20, 3)), 40);
    // A fin on an edge: two of its sides are free, and the third has three triangles.
    TriangleMesh mesh = shapes::geodesic_sphere(2);
    const Triangle base = mesh.triangles[0];
    mesh.positions.emplace_back(2, 2, 2);
    mesh.triangles.push_back({base[0], base[1], 42});
    EXPECT_EQ(count_rim_sides(mesh), 2);
    EXPECT_EQ(stars_of_triangles(mesh).most_triangles_of_edge, 3);
}

std::int32_t imbalance(const TriangleMesh& mesh) {
    return stars_of_triangles(mesh).imbalance;
}

TEST(Stars, TheImbalanceComparesTheDirectionsOfSides) {
    for (TriangleMesh mesh : {shapes::geodesic_sphere(3), shapes::torus(12, 7, 1, 0.3)}) {
        EXPECT_EQ(imbalance(mesh), 0);
        EXPECT_EQ(imbalance(shapes::inside_out(mesh)), 0);
        std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
        EXPECT_EQ(imbalance(mesh), 2) << "one triangle turned";
    }
    for (TriangleMesh mesh : {shapes::square(4), shapes::tube(12, 5, 1)}) {
        EXPECT_EQ(imbalance(mesh), 1);
        std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
        EXPECT_EQ(imbalance(mesh), 2);
    }
    EXPECT_EQ(imbalance(shapes::moebius_band(20, 3)), 2);
    // Three triangles at an edge: two in one direction and one in the other, then all in one.
    TriangleMesh fins{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_EQ(imbalance(fins), 1);
    std::swap(fins.triangles[1][0], fins.triangles[1][1]);
    EXPECT_EQ(imbalance(fins), 3);
}

TEST(Stars, AnEntryIsThePlaceOfANeighbour) {
    const Stars stars = stars_of_triangles(shapes::square(4));
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i)
            EXPECT_EQ(stars.entry(vertex, stars.neighbours[i]), i);
    }
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
