// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// A sphere with a selected cap, and triangles that have two equal vertices: by their numbers, or
/// by their places. They link the cap with the opposite pole, and places around it.
struct Linked {
    explicit Linked(bool by_places) : with(shapes::geodesic_sphere(12)) {
        const auto is_in_cap = [&](std::int32_t i) { return with.positions[i][2] > 0.8; };
        for (const Triangle& t : with.triangles)
            selection.push_back(std::any_of(t.begin(), t.end(), is_in_cap) ? 1 : 0);
        without = with;
        std::vector<std::int32_t> ends;
        for (const double height : {1.0, 0.5, 0.0, -1.0}) {
            const auto is_lower = [&](const auto& a, const auto& b) {
                return std::abs(a[2] - height) < std::abs(b[2] - height);
            };
            const auto nearest =
                std::min_element(without.positions.begin(), without.positions.end(), is_lower);
            ends.push_back(static_cast<std::int32_t>(nearest - without.positions.begin()));
        }
        for (const std::int32_t a : ends) {
            auto copy = a;
            if (by_places) {
                copy = static_cast<std::int32_t>(with.positions.size());
                with.positions.push_back(with.positions[a]);
                without.positions.push_back(with.positions[a]);
            }
            for (const std::int32_t b : ends) {
                if (a == b) continue;
                with.triangles.push_back({a, copy, b});
                selection.push_back(1);
            }
        }
    }

    TriangleMesh with, without;  ///< these triangles
    Selection selection;
};

TEST(Patches, TakeNoLinksFromTrianglesWithTwoEqualVertices) {
    for (const bool by_places : {false, true}) {
        const Linked linked(by_places);
        Selection shorter = linked.selection;
        shorter.resize(linked.without.triangles.size());
        TriangleMesh with = linked.with, without = linked.without;
        const FairReport report = fair(with, linked.selection, {});
        const FairReport of_without = fair(without, shorter, {});
        // The copies are in no triangle of the other mesh.
        for (TriangleMesh* const mesh : {&with, &without})
            mesh->positions.resize(shapes::geodesic_sphere(12).positions.size());
        EXPECT_EQ(distance(with, without), 0);
        EXPECT_EQ(report.patches, 1);
        EXPECT_GT(report.vertices, 0);
        EXPECT_EQ(report.vertices, of_without.vertices);
        EXPECT_EQ(report.rough_patches, 0);
    }
}

TEST(Patches, HaveThreeRings) {
    const TriangleMesh square = shapes::square(20);
    const Surface surface = surface_of(square);
    std::vector<std::uint8_t> moves;
    for (const std::int32_t vertex : surface.mesh_vertices) {
        const Eigen::Vector3d& at = square.positions[vertex];
        moves.push_back((at - Eigen::Vector3d(0.5, 0.5, 0)).norm() < 0.2 ? 1 : 0);
    }
    const std::vector<Patch> patches = patches_of(surface.stars, moves);
    ASSERT_EQ(patches.size(), 1);
    const Patch& patch = patches[0];
    EXPECT_EQ(patch.moving, std::count(moves.begin(), moves.end(), 1));
    EXPECT_LT(patch.moving, patch.held);
    EXPECT_LT(patch.held, patch.inner);
    EXPECT_LT(patch.inner, static_cast<std::int32_t>(patch.vertices.size()));
    for (const Triangle& t : patch.triangles) {
        const auto [first, last] = std::minmax({t[0], t[1], t[2]});
        EXPECT_LT(first, patch.inner);
        EXPECT_TRUE(first >= patch.moving || last < patch.held);
    }
    const std::set<std::int32_t> different(patch.vertices.begin(), patch.vertices.end());
    EXPECT_EQ(different.size(), patch.vertices.size());
}

}  // namespace
}  // namespace tracked_mcf
