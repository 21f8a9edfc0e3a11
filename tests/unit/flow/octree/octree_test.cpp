// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/octree/octree.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TEST(Octree, LevelsNestAndUnknownsAreNumberedAsElementsFirstHaveThem) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    const TrackedElements elements =
        build_tracked_elements(mesh, enclosing_grid(mesh, 5), Cubature::ThreePoints);
    ASSERT_EQ(elements.levels.size(), 6U);
    EXPECT_EQ(elements.levels[0].element_count(), 1);
    EXPECT_EQ(elements.levels[0].unknown_count(), 8);
    for (std::size_t l = 1; l < elements.levels.size(); ++l) {
        const Level& fine = elements.levels[l];
        const Level& coarse = elements.levels[l - 1];
        std::vector<MortonCode> corners;  // of every unknown
        for (std::int32_t e = 0; e < fine.element_count(); ++e) {
            EXPECT_EQ(coarse.cells[fine.parents[e]], parent_of(fine.cells[e]));
            for (int corner = 0; corner < 8; ++corner) {
                const MortonCode code = morton_code(corner_of(cell_at(fine.cells[e]), corner));
                const auto unknown = static_cast<std::size_t>(fine.unknowns[e][corner]);
                ASSERT_LE(unknown, corners.size());
                if (unknown == corners.size()) corners.push_back(code);
                EXPECT_EQ(corners[unknown], code);
            }
        }
        EXPECT_EQ(corners.size(), static_cast<std::size_t>(fine.unknown_count()));
    }
}

TEST(Octree, AllCellsOfACubeHaveOneUnknownPerGridPoint) {
    std::vector<MortonCode> all(512);
    for (MortonCode code = 0; code < 512; ++code) all[code] = code;
    const std::vector<Level> levels = build_levels(all, 3);
    for (const Level& level : levels) {
        const std::int32_t side = 1 << level.depth;
        EXPECT_EQ(level.element_count(), side * side * side);
        EXPECT_EQ(level.unknown_count(), (side + 1) * (side + 1) * (side + 1));
    }
}

TEST(Octree, ElementsShareUnknownsOnlyIfLinked) {
    // Two elements in each of two cells that share a face; only the first elements are linked.
    const std::vector<MortonCode> cells = {0, 0, 1, 1};
    RawVector<Link> links;
    links.push_back({0, 2});
    const std::vector<Level> levels = build_levels(cells, links, 1);
    EXPECT_EQ(levels[1].unknown_count(), 4 * 8 - 4);
    for (int corner = 0; corner < 8; corner += 2) {
        EXPECT_EQ(levels[1].unknowns[0][corner + 1], levels[1].unknowns[2][corner]);
    }
    EXPECT_EQ(levels[0].element_count(), 3);
    EXPECT_EQ(levels[1].parents, (std::vector<std::int32_t>{0, 1, 0, 2}));
    EXPECT_EQ(count_cells(levels[1]), 2);
}

TEST(Links, AreSortedAndCopiesRemoved) {
    RawVector<Link> links;
    for (const auto& [first, second] :
         {std::pair(3, 9), std::pair(0, 7), std::pair(3, 4), std::pair(0, 7), std::pair(3, 9)}) {
        links.push_back({first, second});
    }
    sort_and_remove_copies(links, 10);
    std::vector<std::pair<int, int>> pairs;
    for (const Link& link : links) pairs.emplace_back(link.first, link.second);
    EXPECT_EQ(pairs, (std::vector<std::pair<int, int>>{{0, 7}, {3, 4}, {3, 9}}));
}

}  // namespace
}  // namespace tracked_mcf
