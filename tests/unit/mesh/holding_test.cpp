// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/holding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/fair.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

constexpr auto kLocked = BoundaryCondition::Locked;
constexpr auto kFree = BoundaryCondition::Free;

std::int64_t count_held(const Surface& surface) {
    return std::count(surface.held.begin(), surface.held.end(), 1);
}

int count_held_sides(const Surface& surface) {
    int count = 0;
    for (const std::uint8_t flags : surface.held_sides) {
        for (unsigned side = 0; side < 3; ++side) count += flags >> side & 1U;
    }
    return count;
}

/// Returns, per vertex of the mesh, whether it is held.
std::vector<std::uint8_t> held_of_mesh(const Surface& surface) {
    std::vector<std::uint8_t> held(surface.vertices.size(), 2);
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (surface.vertices[i] >= 0) held[i] = surface.held[surface.vertices[i]];
    }
    return held;
}

TEST(Held, IsTheRimUnlessItIsFree) {
    const TriangleMesh square = shapes::square(4);
    const Surface locked = surface_of(square, {}, kLocked);
    EXPECT_EQ(count_held_sides(locked), 16);
    EXPECT_EQ(count_held(locked), 16);
    const Surface free = surface_of(square, {}, kFree);
    EXPECT_EQ(count_held_sides(free), 0);
    EXPECT_FALSE(free.has_held_vertices());
    EXPECT_EQ(free.counts.boundary_edges, 16);
    EXPECT_FALSE(
        surface_of(shapes::soup(shapes::geodesic_sphere(4)), {}, kLocked).has_held_vertices());
    EXPECT_EQ(count_held(surface_of(shapes::soup(square), {}, kLocked)), 16);
}

TEST(Held, IsTheSeamOfASelectionWhateverTheBoundary) {
    // The left half of a square of 4 by 4 quads has a seam of 4 edges and 8 edges of the boundary.
    const TriangleMesh square = shapes::square(4);
    Selection left;
    for (const Triangle& t : square.triangles) {
        double x = 0;
        for (const std::int32_t vertex : t) x += square.positions[vertex][0] / 3;
        left.push_back(x < 0.5 ? 1 : 0);
    }
    const Surface free = surface_of(square, left, kFree);
    EXPECT_EQ(free.stars.triangles.size(), 16U);
    EXPECT_EQ(free.vertices.size(), square.positions.size());
    EXPECT_EQ(count_held_sides(free), 4);
    EXPECT_EQ(free.counts.boundary_edges, 8);
    EXPECT_EQ(free.counts.unselected, 16);
    EXPECT_EQ(count_held(free), 5);
    EXPECT_EQ(count_held_sides(surface_of(square, left, kLocked)), 12);
}

TEST(Held, SelectingEverythingEqualsNoSelection) {
    const TriangleMesh sphere = shapes::geodesic_sphere(3);
    const std::size_t vertices = sphere.positions.size();
    for (const Inputs& inputs :
         {Inputs(Selection(sphere.triangles.size(), 1)), Inputs({}, std::vector(vertices, 1.0))}) {
        const Surface surface = surface_of(sphere, inputs, kLocked);
        EXPECT_TRUE(surface.is_whole_mesh());
        EXPECT_FALSE(surface.has_held_vertices());
        TriangleMesh mesh = sphere;
        EXPECT_GT(evolve(mesh, inputs, {}).volume_before, 3);
    }
}

TEST(Held, AreNoVerticesThatTheSurfaceDoesNotHave) {
    // Two spheres, of which one is selected; and a strength of 0 where no face is.
    const TriangleMesh sphere = shapes::geodesic_sphere(4);
    TriangleMesh two = shapes::merged(
        sphere, shapes::transformed(sphere, Eigen::Affine3d(Eigen::Translation3d(9, 0, 0))));
    Selection first(two.triangles.size(), 0);
    std::fill_n(first.begin(), sphere.triangles.size(), std::uint8_t{1});
    EXPECT_FALSE(surface_of(two, first, kLocked).has_held_vertices());
    FlowParameters area;
    area.preserve = Preserve::Area;
    EXPECT_EQ(evolve(two, first, area).held_vertices, 0);
    FlowParameters round;
    round.flow = FlowKind::Conformalized;
    round.preserve = Preserve::Volume;
    const FlowReport report = evolve(two, first, round);
    EXPECT_NEAR(report.volume_change, 0, 1e-9);
    EXPECT_TRUE(std::isnan(report.volume_before));
    TriangleMesh stray = sphere;
    stray.positions.emplace_back(3, 3, 3);
    std::vector<double> strengths(stray.positions.size(), 1);
    strengths.back() = 0;
    EXPECT_EQ(evolve(stray, Inputs({}, strengths), area).stop, Stop::None);
    // All vertices of the only triangle are held. A face without three vertices moves nothing.
    TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{0, 1, 2}, {3, 3, 0}}};
    EXPECT_EQ(evolve(triangle, FlowParameters()).stop, Stop::NothingMoves);
}

TEST(Held, AreEdgesOfTwoSelectedTrianglesIfAnUnselectedOneHasThem) {
    // Three triangles that share the edge from vertex 0 to vertex 1.
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                            {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    const Surface surface = surface_of(mesh, {{1, 1, 0}}, kFree);
    EXPECT_EQ(held_of_mesh(surface), (std::vector<std::uint8_t>{1, 1, 0, 0, 2}));
    EXPECT_EQ(count_held_sides(surface), 2);
    EXPECT_EQ(surface.counts.boundary_edges, 4);
}

TEST(Held, IsAVertexThatTouchesAnUnselectedTriangle) {
    // Two triangles with one vertex in common.
    const TriangleMesh bow_tie{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                               {{0, 1, 2}, {0, 3, 4}}};
    const Surface surface = surface_of(bow_tie, {{1, 0}}, kFree);
    EXPECT_EQ(count_held_sides(surface), 0);
    EXPECT_EQ(held_of_mesh(surface), (std::vector<std::uint8_t>{1, 0, 0, 2, 2}));
}

TEST(Held, AreVerticesWithStrengthZeroAndTrianglesOfThem) {
    const TriangleMesh square = shapes::square(4);
    std::vector<double> strengths(square.positions.size());
    std::transform(square.positions.begin(), square.positions.end(), strengths.begin(),
                   [](const Eigen::Vector3d& p) { return p.x() > 0.6 ? 0 : 1; });
    const Surface surface = surface_of(square, Inputs({}, strengths), kFree);
    EXPECT_EQ(surface.counts.zero_strength, 8);
    EXPECT_EQ(surface.counts.unselected, 0);
    EXPECT_EQ(surface.counts.triangles, 24);
    EXPECT_EQ(count_held(surface), 5);
    EXPECT_FALSE(surface.is_whole_mesh());
    EXPECT_THROW(surface_of(square, Inputs({}, std::vector<double>(25, 0)), kFree), InvalidMesh);
}

/// Adds to every boundary edge a triangle without area: the edge's ends and its midpoint.
TriangleMesh with_slivers_on_the_boundary(TriangleMesh mesh) {
    const Surface surface = surface_of(mesh);
    for (std::size_t i = 0; i < surface.stars.rim_sides.size(); ++i) {
        if (surface.stars.rim_sides[i] == 0) continue;
        const Triangle t = surface.mesh_triangle(static_cast<std::int64_t>(i / 3));
        const std::int32_t a = t[i % 3], b = t[(i + 1) % 3];
        const auto middle = static_cast<std::int32_t>(mesh.positions.size());
        mesh.positions.emplace_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
        mesh.triangles.push_back({b, a, middle});
    }
    return mesh;
}

TEST(Held, SliversOnTheBoundaryDoNotFreeIt) {
    const TriangleMesh cap = bumpy_cap(20);
    const TriangleMesh ragged = with_slivers_on_the_boundary(cap);
    ASSERT_GT(ragged.triangles.size(), cap.triangles.size() + 40);
    FlowParameters p = parameters(5, 1e-3, 3);
    p.tolerance = 1e-6;
    const TriangleMesh expected = evolved(cap, p);
    const TriangleMesh after = evolved(ragged, p);
    for (std::size_t i = 0; i < cap.positions.size(); ++i) {
        EXPECT_LT((after.positions[i] - expected.positions[i]).norm(), 1e-6);
    }
    for (std::size_t i = cap.positions.size(); i < ragged.positions.size(); ++i) {
        EXPECT_EQ(after.positions[i], ragged.positions[i]);
    }
}

TEST(Held, ChainsOfSliversPassItOn) {
    // Two slivers beside each other, of which only the first one's side is on the seam.
    const TriangleMesh mesh{
        {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-10, 0}, {0.6, 2e-10, 0}, {0.5, 1, 0}, {0.5, -1, 0}},
        {{0, 1, 2}, {2, 1, 3}, {0, 2, 4}, {2, 3, 4}, {3, 1, 4}, {1, 0, 5}}};
    const Surface surface = surface_of(mesh, {{1, 1, 1, 1, 1, 0}}, kFree);
    EXPECT_EQ(held_of_mesh(surface), (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 2}));
}

TEST(Held, ByASelectionAloneAreNoSlivers) {
    // fair() moves all inner vertices, also one beside the seam.
    TriangleMesh mesh = shapes::square(8);
    Selection selection;
    for (const Triangle& t : mesh.triangles) {
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (const std::int32_t vertex : t) middle += mesh.positions[vertex] / 3;
        const Eigen::Array2d from_centre = (middle.head<2>().array() - 0.5).abs();
        selection.push_back(from_centre.maxCoeff() < 0.25 ? 1 : 0);
    }
    const std::int64_t before = fair(mesh, selection, {}).vertices;
    EXPECT_EQ(before, 9);
    const auto is_at = [&](double x, double y) {
        return [=](const Eigen::Vector3d& p) {
            return std::abs(p.x() - x) < 1e-9 && std::abs(p.y() - y) < 1e-9;
        };
    };
    mesh = shapes::square(8);
    auto inner = std::find_if(mesh.positions.begin(), mesh.positions.end(), is_at(0.5, 0.375));
    ASSERT_NE(inner, mesh.positions.end());
    inner->y() = 0.25 + 1e-10;
    EXPECT_EQ(fair(mesh, selection, {}).vertices, before);
}

TEST(Held, SelectionsOfNothingOrOfTheWrongSizeAreErrors) {
    const TriangleMesh square = shapes::square(2);
    EXPECT_THROW(validate(square, Selection(8, 0)), InvalidMesh);
    EXPECT_THROW(validate(square, Selection(7, 1)), InvalidParameter);
    TriangleMesh mesh = square;
    EXPECT_THROW(evolve(mesh, Selection(8, 0), {}), InvalidMesh);
    EXPECT_TRUE(same_bits(mesh, square));
}

}  // namespace
}  // namespace tracked_mcf
