// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/element_matrix.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// Stores one symmetric 8×8 matrix per element of a level, in blocks of sixteen elements. Only the
/// upper triangles are stored, which takes 36/64 of the memory of whole matrices.
class MatrixBlocks {
public:
    MatrixBlocks() = default;
    /// Makes room for `count` matrices, as resize() does.
    explicit MatrixBlocks(std::int64_t count) { resize(count); }

    /// Makes room for `count` matrices, each of which must then be set. Unused places of the last
    /// block are zero.
    void resize(std::int64_t count);

    std::int64_t size() const { return count_; }

    float at(std::int64_t element, int row, int column) const {
        return blocks_[element / kBlockElements]
            .entry[kEntryIndices.of[row][column]][element % kBlockElements];
    }
    /// Returns the entry that stands for both (row, column) and (column, row).
    float& at(std::int64_t element, int row, int column) {
        return blocks_[element / kBlockElements]
            .entry[kEntryIndices.of[row][column]][element % kBlockElements];
    }
    /// Returns a copy of one matrix.
    ElementMatrix of(std::int64_t element) const;

    std::int64_t block_count() const { return static_cast<std::int64_t>(blocks_.size()); }
    MatrixBlock* blocks() { return blocks_.data(); }
    const MatrixBlock* blocks() const { return blocks_.data(); }

private:
    std::int64_t count_ = 0;
    RawVector<MatrixBlock> blocks_;
};

// The chunks of a parallel loop (parallel.h) hold whole matrix blocks, so in one loop over elements
// only one thread writes to a matrix block.
static_assert(kChunkSize % kBlockElements == 0);

}  // namespace tracked_mcf
