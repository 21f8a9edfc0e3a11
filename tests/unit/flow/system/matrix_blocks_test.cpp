// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tracked_mcf {
namespace {

/// A number that no other entry of a symmetric matrix, and no other element, has.
float number_of(std::int64_t element, int row, int column) {
    return static_cast<float>(64 * element + 8 * std::min(row, column) + std::max(row, column));
}

MatrixBlocks numbered(std::int64_t count) {
    MatrixBlocks matrices(count);
    for (std::int64_t element = 0; element < count; ++element) {
        for (int row = 0; row < 8; ++row) {
            for (int column = row; column < 8; ++column) {
                matrices.at(element, row, column) = number_of(element, row, column);
            }
        }
    }
    return matrices;
}

TEST(MatrixBlocks, StoreASymmetricMatrixForEachElement) {
    const MatrixBlocks matrices = numbered(2 * kBlockElements + 5);
    EXPECT_EQ(matrices.block_count(), 3);
    for (std::int64_t element = 0; element < matrices.size(); ++element) {
        const ElementMatrix whole = matrices.of(element);
        for (int row = 0; row < 8; ++row) {
            for (int column = 0; column < 8; ++column) {
                EXPECT_EQ(matrices.at(element, row, column), number_of(element, row, column));
                EXPECT_EQ(whole.entry[row][column], number_of(element, row, column));
            }
        }
    }
}

TEST(MatrixBlocks, AreZeroBeyondTheLastElement) {
    // Kernels work on whole blocks: what follows the last element must not be a NaN.
    MatrixBlocks matrices = numbered(3 * kBlockElements);
    matrices.resize(kBlockElements + 5);
    const MatrixBlock& last = matrices.blocks()[matrices.block_count() - 1];
    for (const auto& entry : last.entry) {
        for (int element = 5; element < kBlockElements; ++element) EXPECT_EQ(entry[element], 0);
    }
}

}  // namespace
}  // namespace tracked_mcf
