// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/grid.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TEST(Grid, CubeIsATenthLargerThanTheLongestSideAndCentred) {
    const TriangleMesh mesh = shapes::box(2, {1, 4, 2});
    const Grid grid = enclosing_grid(bounding_box(mesh), 3);
    EXPECT_DOUBLE_EQ(grid.cell_size, 4.4 / 8);
    EXPECT_LT((grid.to_grid({0.5, 2, 1}) - Eigen::Vector3d::Constant(4)).norm(), 1e-14);
}

TEST(Grid, WithAnotherDepthHasTheSameCube) {
    const Grid coarse = enclosing_grid(bounding_box(shapes::box(2, {1, 4, 2})), 3);
    const Grid fine = with_depth(coarse, 7);
    EXPECT_EQ(fine.origin, coarse.origin);
    EXPECT_EQ(fine.cell_size * fine.cells_per_side(), coarse.cell_size * coarse.cells_per_side());
}

TEST(Morton, DecodingInvertsEncoding) {
    std::mt19937 random(5);
    std::uniform_int_distribution<std::int32_t> coordinate(0, (1 << 21) - 1);
    for (int i = 0; i < 1000; ++i) {
        const Cell cell(coordinate(random), coordinate(random), coordinate(random));
        EXPECT_EQ(cell_at(morton_code(cell)), cell);
    }
}

TEST(Morton, CodesListCellsDepthFirst) {
    // The codes of a cube of 4 cells a side are 0 to 63, parent by parent, octant by octant.
    for (MortonCode code = 0; code < 64; ++code) {
        const Cell cell = cell_at(code);
        EXPECT_LT(cell.maxCoeff(), 4);
        EXPECT_EQ(cell_at(parent_of(code)), cell / 2);
        const Cell octant = cell - 2 * (cell / 2);
        EXPECT_EQ(octant_of(code), octant[0] + 2 * octant[1] + 4 * octant[2]);
    }
}

}  // namespace
}  // namespace tracked_mcf
