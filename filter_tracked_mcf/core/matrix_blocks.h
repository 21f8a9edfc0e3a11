#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/raw_vector.h"

namespace tracked_mcf {

/// One symmetric matrix for each of a level's elements, in blocks of sixteen: little more than
/// half the memory of whole matrices.
class MatrixBlocks {
public:
    MatrixBlocks() = default;
    /// Of so many elements, see resize().
    explicit MatrixBlocks(std::int64_t count) { resize(count); }

    /// Each matrix must then be set. What the last block has beyond the last element is zero.
    void resize(std::int64_t count);

    std::int64_t size() const { return count_; }

    float at(std::int64_t element, int row, int column) const {
        return block_of(element).entry[kEntryPlaces.of[row][column]][element % kBlockElements];
    }
    /// Both (row, column) and (column, row).
    float& at(std::int64_t element, int row, int column) {
        return blocks_[element / kBlockElements]
            .entry[kEntryPlaces.of[row][column]][element % kBlockElements];
    }
    /// A copy of one.
    ElementMatrix of(std::int64_t element) const;

    std::int64_t block_count() const { return static_cast<std::int64_t>(blocks_.size()); }
    MatrixBlock* blocks() { return blocks_.data(); }
    const MatrixBlock* blocks() const { return blocks_.data(); }

private:
    const MatrixBlock& block_of(std::int64_t element) const {
        return blocks_[element / kBlockElements];
    }

    std::int64_t count_ = 0;
    RawVector<MatrixBlock> blocks_;
};

// Threads share out elements by these blocks, and must not share a block of matrices.
static_assert(kBlockSize % kBlockElements == 0);

}  // namespace tracked_mcf
