// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

void MatrixBlocks::resize(std::int64_t count) {
    count_ = count;
    blocks_.resize(static_cast<std::size_t>((count + kBlockElements - 1) / kBlockElements));
    if (!blocks_.empty()) blocks_.back() = MatrixBlock{};
}

ElementMatrix MatrixBlocks::of(std::int64_t element) const {
    ElementMatrix matrix;
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            matrix.entry[row][column] = at(element, row, column);
        }
    }
    return matrix;
}

}  // namespace tracked_mcf
