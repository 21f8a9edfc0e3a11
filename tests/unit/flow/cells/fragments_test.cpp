// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/fragments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

ClippedSurface clipped(const TriangleMesh& mesh, int depth) {
    return clip_to_grid(mesh, enclosing_grid(bounding_box(mesh), depth));
}

TEST(Fragments, AreSortedByCellThenByTriangle) {
    const ClippedSurface surface = clipped(shapes::bumpy_sphere(8), 4);
    const auto before = [](const FragmentEntry& a, const FragmentEntry& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.triangle < b.triangle;
    };
    EXPECT_TRUE(std::is_sorted(surface.fragments.begin(), surface.fragments.end(), before));
}

TEST(Fragments, EveryCornerAndEveryEdgeOfATriangleLiesInOneOfItsFragments) {
    const TriangleMesh mesh = shapes::merged(shapes::bumpy_sphere(8), shapes::square(3));
    std::vector<unsigned> corners(mesh.triangles.size(), 0), edges(mesh.triangles.size(), 0);
    for (const FragmentEntry& fragment : clipped(mesh, 4).fragments) {
        corners[fragment.triangle] |= static_cast<unsigned>(fragment.corners);
        edges[fragment.triangle] |= static_cast<unsigned>(fragment.edges);
    }
    EXPECT_EQ(corners, std::vector<unsigned>(mesh.triangles.size(), 7));
    EXPECT_EQ(edges, corners);
}

TEST(Fragments, FlagsSayWhichCornersAndSidesAreInTheCell) {
    // Cells of side 1: the triangle's corner 0 lies in one cell, corners 1 and 2 in the next.
    const TriangleMesh mesh{{{0.5, 0.5, 0.5}, {1.5, 0.4, 0.5}, {1.5, 0.6, 0.5}}, {{0, 1, 2}}};
    const ClippedSurface surface = clip_to_grid(mesh, {Eigen::Vector3d::Zero(), 1, 2});
    ASSERT_EQ(surface.fragments.size(), 2U);
    EXPECT_EQ(surface.fragments[0].corners, 1U);
    EXPECT_EQ(surface.fragments[0].edges, 0b101U);
    EXPECT_EQ(surface.fragments[0].split_triangles, 1U);
    EXPECT_EQ(surface.fragments[1].corners, 0b110U);
    EXPECT_EQ(surface.fragments[1].edges, 0b111U);
    EXPECT_EQ(surface.fragments[1].split_triangles, 2U);
}

TEST(Fragments, OfDegenerateTrianglesCarryNoAreaButTheirCorners) {
    TriangleMesh mesh = shapes::square(1);
    mesh.triangles.push_back({0, 1, 1});
    const ClippedSurface surface = clipped(mesh, 2);
    EXPECT_EQ(surface.degenerate_count, 1);
    unsigned corners = 0;
    for (const FragmentEntry& fragment : surface.fragments) {
        if (fragment.triangle != 2) continue;
        EXPECT_EQ(fragment.split_triangles, 0U);
        corners |= static_cast<unsigned>(fragment.corners);
    }
    EXPECT_EQ(corners, 7U);
}

TEST(GridMesh, PutsAFaceIntoTheGridPlaneThatItMissesByRounding) {
    TriangleMesh mesh = shapes::square(2);
    for (Eigen::Vector3d& p : mesh.positions) p[2] = 0.5 + 1e-12 * p[0];
    const GridMesh in_grid = to_grid(mesh, {Eigen::Vector3d::Zero(), 0.25, 2});
    for (const Eigen::Vector3d& p : in_grid.positions) EXPECT_EQ(p[2], 2);
}

}  // namespace
}  // namespace tracked_mcf
