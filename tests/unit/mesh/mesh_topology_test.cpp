// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

int count_boundary(const TriangleMesh& mesh) {
    int count = 0;
    for (const std::uint8_t flags : topology_of(mesh).boundary) {
        for (int side = 0; side < 3; ++side) count += has_bit(flags, side) ? 1 : 0;
    }
    return count;
}

/// Returns the number of closed curves that make up the boundary.
std::size_t count_boundary_curves(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    const std::vector<std::uint8_t>& boundary = topology.boundary;
    DisjointSets vertices(static_cast<std::int32_t>(topology.welded.size()));
    std::vector<std::int32_t> on_boundary;
    for (std::size_t triangle = 0; triangle < boundary.size(); ++triangle) {
        const Triangle& t = topology.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(boundary[triangle], side)) continue;
            vertices.unite(t[side], t[(side + 1) % 3]);
            on_boundary.push_back(t[side]);
        }
    }
    std::set<std::int32_t> curves;
    for (const std::int32_t vertex : on_boundary) curves.insert(vertices.find(vertex));
    return curves.size();
}

/// Returns V - E + F.
std::int64_t euler_characteristic(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    return count_vertices(topology) - topology.edge_count +
           static_cast<std::int64_t>(topology.triangles.size());
}

TEST(MeshTopology, EulerCharacteristics) {
    EXPECT_EQ(euler_characteristic(shapes::geodesic_sphere(5)), 2);
    EXPECT_EQ(euler_characteristic(shapes::soup(shapes::geodesic_sphere(5))), 2);
    EXPECT_EQ(euler_characteristic(shapes::torus(12, 7, 1, 0.3)), 0);
    EXPECT_EQ(euler_characteristic(shapes::square(4)), 1);
    EXPECT_EQ(euler_characteristic(shapes::moebius_band(20, 3)), 0);
}

TEST(MeshTopology, EdgesAreNumberedByTheirSmallerThenTheirLargerVertex) {
    const MeshTopology topology = topology_of(shapes::bumpy_sphere(4));
    std::vector<std::array<std::int32_t, 2>> ends(static_cast<std::size_t>(topology.edge_count));
    for (std::size_t triangle = 0; triangle < topology.triangles.size(); ++triangle) {
        const Triangle& t = topology.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
            ends.at(static_cast<std::size_t>(topology.edges[triangle][side])) = {a, b};
        }
    }
    EXPECT_TRUE(std::is_sorted(ends.begin(), ends.end()));
    EXPECT_EQ(std::adjacent_find(ends.begin(), ends.end()), ends.end());
}

TEST(MeshTopology, AnyNumberOfTrianglesShareAnEdge) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                            {{0, 1, 2}, {1, 0, 3}, {4, 0, 1}}};
    const MeshTopology topology = topology_of(mesh);
    EXPECT_EQ(topology.edge_count, 7);
    EXPECT_EQ(topology.edges[0][0], topology.edges[1][0]);
    EXPECT_EQ(topology.edges[0][0], topology.edges[2][1]);
}

TEST(MeshTopology, SidesFromAVertexToItselfAreNoEdges) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}};
    const MeshTopology topology = topology_of(mesh);
    EXPECT_EQ(topology.edge_count, 1);
    EXPECT_EQ(topology.edges[0], (std::array<std::int32_t, 3>{0, MeshTopology::kNoEdge, 0}));
}

TEST(BoundaryEdges, OfClosedOpenAndLooseMeshes) {
    EXPECT_EQ(count_boundary(shapes::geodesic_sphere(3)), 0);
    EXPECT_EQ(count_boundary(shapes::square(5)), 20);
    EXPECT_EQ(count_boundary(shapes::soup(shapes::geodesic_sphere(3))), 0);
}

TEST(BoundaryEdges, OfAFinAndOfRepeatedIndices) {
    TriangleMesh mesh = shapes::geodesic_sphere(2);
    const Triangle base = mesh.triangles[0];
    mesh.positions.emplace_back(2, 2, 2);
    mesh.triangles.push_back(
        {base[0], base[1], 42});  // a fin on an edge: two of its sides are free
    EXPECT_EQ(count_boundary(mesh), 2);
    mesh.triangles.push_back({42, 42, base[0]});  // closes nothing
    EXPECT_EQ(count_boundary(mesh), 2);
}

TEST(BoundaryEdges, OfASheetWithTwoFaces) {
    TriangleMesh mesh = shapes::square(5);
    const std::vector<Triangle> front = mesh.triangles;
    for (const Triangle& t : front) mesh.triangles.push_back({t[0], t[2], t[1]});
    EXPECT_EQ(count_boundary(mesh), 2 * 20);
}

TEST(BoundaryEdges, OfAMoebiusBandAreOneCurveAndOfATubeTwo) {
    EXPECT_EQ(count_boundary(shapes::moebius_band(20, 3)), 40);
    EXPECT_EQ(count_boundary_curves(shapes::moebius_band(20, 3)), 1U);
    EXPECT_EQ(count_boundary_curves(shapes::tube(20, 3, 1)), 2U);
}

bool oriented(const TriangleMesh& mesh) {
    return topology_of(mesh).is_oriented_consistently();
}

bool bounds(const TriangleMesh& mesh) {
    return topology_of(mesh).bounds_volume();
}

TEST(Orientation, OfClosedSurfaces) {
    for (TriangleMesh mesh : {shapes::geodesic_sphere(3), shapes::torus(12, 7, 1, 0.3),
                              shapes::soup(shapes::geodesic_sphere(3))}) {
        EXPECT_TRUE(oriented(mesh) && bounds(mesh));
        for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
        EXPECT_TRUE(oriented(mesh) && bounds(mesh)) << "inside out";
        std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
        EXPECT_FALSE(oriented(mesh) || bounds(mesh)) << "one triangle turned";
    }
}

TEST(Orientation, OfOpenSurfacesIsConsistentButTheyBoundNoVolume) {
    for (TriangleMesh mesh : {shapes::square(4), shapes::tube(12, 5, 1)}) {
        EXPECT_TRUE(oriented(mesh));
        EXPECT_FALSE(bounds(mesh));
        std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
        EXPECT_FALSE(oriented(mesh));
    }
    EXPECT_FALSE(oriented(shapes::moebius_band(20, 3)));
}

TEST(Orientation, OfEdgesWithManyTriangles) {
    // Two boxes that share an edge: four triangles, two in each direction.
    TriangleMesh boxes =
        shapes::merged(shapes::box(2, {1, 1, 1}),
                       shapes::transformed(shapes::box(2, {1, 1, 1}),
                                           Eigen::Affine3d(Eigen::Translation3d(1, 1, 0))));
    EXPECT_TRUE(oriented(boxes) && bounds(boxes));
    // Three triangles: two in one direction and one in the other, then all in one direction.
    TriangleMesh fins{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_TRUE(oriented(fins));
    EXPECT_FALSE(bounds(fins));
    std::swap(fins.triangles[1][0], fins.triangles[1][1]);
    EXPECT_FALSE(oriented(fins));
}

TEST(Genus, IsTheNumberOfHandlesOfAllComponents) {
    const auto genus = [](const TriangleMesh& mesh) { return genus_of(topology_of(mesh)); };
    const TriangleMesh sphere = shapes::geodesic_sphere(3), torus = shapes::torus(12, 8, 3, 1);
    EXPECT_EQ(genus(sphere), 0);
    EXPECT_EQ(genus(torus), 1);
    EXPECT_EQ(genus(shapes::merged(sphere, torus)), 1);
    EXPECT_EQ(
        genus(shapes::merged(
            torus, shapes::transformed(torus, Eigen::Affine3d(Eigen::Translation3d(9, 0, 0))))),
        2);
    TriangleMesh open = torus;
    open.triangles.pop_back();
    EXPECT_EQ(genus(open), 0);
}

}  // namespace
}  // namespace tracked_mcf
