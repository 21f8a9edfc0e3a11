// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/domain.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

constexpr auto kLocked = BoundaryCondition::Locked;
constexpr auto kFree = BoundaryCondition::Free;

int count_constrained_edges(const Domain& domain) {
    int count = 0;
    for (const std::uint8_t flags : domain.constrained_edges()) {
        for (int side = 0; side < 3; ++side) count += has_bit(flags, side) ? 1 : 0;
    }
    return count;
}

std::int64_t count_constrained_vertices(const Domain& domain) {
    const auto& flags = domain.constrained_vertices();
    return std::count_if(flags.begin(), flags.end(), [](auto flag) { return flag != 0; });
}

/// Three triangles that share the edge from vertex 0 to vertex 1.
TriangleMesh fin() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
            {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
}

TEST(Domain, TheBoundaryIsConstrainedUnlessItIsFree) {
    const TriangleMesh square = shapes::square(4);
    const Domain locked(square, kLocked);
    EXPECT_EQ(count_constrained_edges(locked), 16);
    EXPECT_EQ(count_constrained_vertices(locked), 16);
    EXPECT_TRUE(locked.has_constraints());
    const Domain free(square, kFree);
    EXPECT_EQ(count_constrained_edges(free), 0);
    EXPECT_FALSE(free.has_constraints());
    EXPECT_EQ(free.boundary_edge_count(), 16);
}

TEST(Domain, SeamsOfCoincidentVerticesAreNoBoundary) {
    EXPECT_FALSE(Domain(shapes::soup(shapes::geodesic_sphere(4)), kLocked).has_constraints());
    const TriangleMesh soup = shapes::soup(shapes::square(4));
    const Domain domain(soup, kLocked);
    EXPECT_EQ(count_constrained_edges(domain), 16);
    for (std::size_t vertex = 0; vertex < soup.positions.size(); ++vertex) {
        const Eigen::Vector3d& p = soup.positions[vertex];
        const bool on_boundary = p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
        EXPECT_EQ(domain.constrained_vertices()[vertex], on_boundary ? 1 : 0);
    }
}

TEST(Domain, TheSeamOfASelectionIsConstrainedWhateverTheBoundary) {
    // The left half of a square of 4 by 4 quads has a seam of 4 edges and 8 edges of the boundary.
    const TriangleMesh square = shapes::square(4);
    Selection left;
    for (const Triangle& t : square.triangles) {
        double x = 0;
        for (const std::int32_t vertex : t) x += square.positions[vertex][0] / 3;
        left.push_back(x < 0.5 ? 1 : 0);
    }
    const Domain free(square, left, kFree);
    EXPECT_EQ(free.surface().triangles.size(), 16U);
    EXPECT_EQ(free.surface().positions.size(), square.positions.size());
    EXPECT_EQ(free.topology().triangles.size(), 16U);
    EXPECT_EQ(count_constrained_edges(free), 4);
    EXPECT_EQ(free.boundary_edge_count(), 8);
    EXPECT_EQ(count_constrained_vertices(free),
              15);  // those of the seam and of unselected triangles
    EXPECT_EQ(count_constrained_edges(Domain(square, left, kLocked)), 12);
}

TEST(Domain, SelectingEverythingEqualsNoSelection) {
    const TriangleMesh square = shapes::square(3);
    const Domain domain(square, Selection(square.triangles.size(), 1), kLocked);
    EXPECT_EQ(domain.constrained_edges(), Domain(square, kLocked).constrained_edges());
    EXPECT_EQ(domain.constrained_vertices(), Domain(square, kLocked).constrained_vertices());
}

TEST(Domain, AnEdgeOfTwoSelectedTrianglesIsConstrainedIfAnUnselectedOneHasIt) {
    const TriangleMesh mesh = fin();
    const Domain domain(mesh, {{1, 1, 0}}, kFree);
    EXPECT_EQ(domain.constrained_edges(), (std::vector<std::uint8_t>{1, 1}));
    EXPECT_EQ(domain.constrained_vertices(), (std::vector<std::uint8_t>{1, 1, 0, 0, 1}));
}

TEST(Domain, AVertexThatTouchesAnUnselectedTriangleIsConstrained) {
    // Two triangles with one vertex in common.
    const TriangleMesh bow_tie{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                               {{0, 1, 2}, {0, 3, 4}}};
    const Domain domain(bow_tie, {{1, 0}}, kFree);
    EXPECT_EQ(count_constrained_edges(domain), 0);
    EXPECT_EQ(domain.constrained_vertices(), (std::vector<std::uint8_t>{1, 0, 0, 1, 1}));
}

/// Adds to every boundary edge a triangle without area: the edge's ends and its midpoint.
TriangleMesh with_slivers_on_the_boundary(TriangleMesh mesh) {
    const std::vector<std::uint8_t> boundary = topology_of(mesh).boundary;
    for (std::size_t t = 0; t < boundary.size(); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(boundary[t], side)) continue;
            const std::int32_t a = mesh.triangles[t][side], b = mesh.triangles[t][(side + 1) % 3];
            const auto middle = static_cast<std::int32_t>(mesh.positions.size());
            mesh.positions.emplace_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
            mesh.triangles.push_back({b, a, middle});
        }
    }
    return mesh;
}

TEST(Domain, SliversOnTheBoundaryDoNotFreeIt) {
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

TEST(Domain, SelectionsOfNothingOrOfTheWrongSizeAreErrors) {
    const TriangleMesh square = shapes::square(2);
    EXPECT_THROW(validate(square, Selection(8, 0)), InvalidMesh);
    EXPECT_THROW(validate(square, Selection(7, 1)), InvalidParameter);
    TriangleMesh mesh = square;
    EXPECT_THROW(evolve(mesh, Selection(8, 0), {}), InvalidMesh);
    EXPECT_TRUE(same_bits(mesh, square));
}

}  // namespace
}  // namespace tracked_mcf
