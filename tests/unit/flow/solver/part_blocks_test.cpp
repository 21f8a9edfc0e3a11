// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/part_blocks.h"

#include <gtest/gtest.h>

#include <vector>

namespace tracked_mcf {
namespace {

/// Returns the part of each row, given the number of rows of each part.
std::vector<std::int32_t> parts_of_sizes(const std::vector<int>& sizes) {
    std::vector<std::int32_t> parts;
    for (std::size_t part = 0; part < sizes.size(); ++part)
        parts.insert(parts.end(), static_cast<std::size_t>(sizes[part]),
                     static_cast<std::int32_t>(part));
    return parts;
}

TEST(PartBlocks, CutEachPartFromItsFirstRowOn) {
    const PartBlocks blocks(parts_of_sizes({3, 2500, 1024, 4, 5}));
    ASSERT_EQ(blocks.part_count(), 5);
    ASSERT_EQ(blocks.count(), 7);
    const std::vector<int> begins = {0, 3, 1027, 2051, 2503, 3527, 3531, 3536};
    const std::vector<int> parts = {0, 1, 1, 1, 2, 3, 4};
    for (std::int32_t i = 0; i < blocks.count(); ++i) {
        EXPECT_EQ(blocks[i].begin, begins[i]);
        EXPECT_EQ(blocks[i].end, begins[i + 1]);
        EXPECT_EQ(blocks[i].part, parts[i]);
    }
    EXPECT_EQ(blocks.of_part(1).first, 1);
    EXPECT_EQ(blocks.of_part(1).last, 4);
}

TEST(PartBlocks, ChunksHaveWholeBlocksAndAreNotTooLarge) {
    std::vector<int> sizes(2000, 3);
    sizes[700] = 5000;
    const PartBlocks blocks(parts_of_sizes(sizes));
    std::int32_t next = 0;
    for (std::int32_t chunk = 0; chunk < blocks.chunk_count(); ++chunk) {
        const auto [first, last] = blocks.of_chunk(chunk);
        EXPECT_EQ(first, next);
        EXPECT_LE(blocks[last - 1].end - blocks[first].begin, kChunkSize);
        for (std::int32_t block = first; block < last; ++block)
            EXPECT_EQ(blocks[block].chunk, chunk);
        next = last;
    }
    EXPECT_EQ(next, blocks.count());
    EXPECT_LT(blocks.chunk_count(), 16) << "of 11 000 rows";
}

TEST(PartBlocks, OfNoRowsAreNone) {
    const PartBlocks blocks(parts_of_sizes({}));
    EXPECT_EQ(blocks.count(), 0);
    EXPECT_EQ(blocks.part_count(), 0);
    EXPECT_EQ(blocks.chunk_count(), 0);
}

}  // namespace
}  // namespace tracked_mcf
