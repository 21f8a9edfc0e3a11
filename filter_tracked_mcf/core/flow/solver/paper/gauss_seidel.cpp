// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/gauss_seidel.h"

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// Large enough that few unknowns are at the cuts, small enough to share among many threads.
constexpr std::int32_t kSmallestSlab = 8192;

void relax(const LevelMatrix& matrix, const Field& right_side, Field& x, std::int32_t row) {
    const float inverse = matrix.inverse_diagonal()[row];
    if (inverse == 0) return;
    x.col(row) += inverse * (right_side.col(row) - row_times(matrix.matrix(), row, x));
}

/// Returns the unknowns, sorted by the lexicographic number of their corners. `side` is the number
/// of corners along a side of the grid.
std::vector<KeyValue> sorted_by_corner(const Level& level, std::uint64_t side) {
    std::vector<KeyValue> unknowns(level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        const Cell cell = cell_at(level.cells[element]);
        for (int i = 0; i < 8; ++i) {
            const auto corner = corner_of(cell, i).cast<std::uint64_t>().eval();
            const auto unknown = static_cast<std::uint64_t>(level.unknowns[element][i]);
            unknowns[unknown] = {(corner[2] * side + corner[1]) * side + corner[0], unknown};
        }
    }
    sort_by_key(unknowns);
    return unknowns;
}

}  // namespace

GaussSeidel::GaussSeidel(const Level& level) {
    const std::uint64_t side = (std::uint64_t{1} << static_cast<unsigned>(level.depth)) + 1;
    std::uint64_t layer = 0;
    slab_begin_.push_back(0);
    for (const KeyValue& unknown : sorted_by_corner(level, side)) {
        const auto offset = static_cast<std::int32_t>(order_.size());
        const bool new_layer = layer != unknown.key / (side * side);
        if (new_layer && offset - slab_begin_.back() >= kSmallestSlab) {
            slab_begin_.push_back(offset);
        }
        layer = unknown.key / (side * side);
        order_.push_back(static_cast<std::int32_t>(unknown.value));
    }
    slab_begin_.push_back(static_cast<std::int32_t>(order_.size()));
}

void GaussSeidel::sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const {
    const auto slabs = static_cast<std::int64_t>(slab_begin_.size()) - 1;
    for (const std::int64_t first_slab : {0, 1}) {
        parallel_for((slabs - first_slab + 1) / 2, [&](std::int64_t i) {
            const std::int64_t slab = first_slab + 2 * i;
            Pacer pacer;  // a flat surface has few, large layers
            for (std::int32_t k = slab_begin_[slab]; k < slab_begin_[slab + 1]; ++k) {
                pacer.did(1);
                relax(matrix, right_side, x, order_[k]);
            }
        });
    }
}

}  // namespace tracked_mcf
