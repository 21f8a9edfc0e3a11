#include "filter_tracked_mcf/core/gauss_seidel.h"

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// Large enough that few unknowns lie at a cut, small enough to share among many threads.
constexpr std::int32_t kSmallestSlab = 8192;

void relax(const LevelMatrix& matrix, const Field& right_side, Field& x, std::int32_t row) {
    const float inverse = matrix.inverse_diagonal()[row];
    if (inverse == 0) return;
    x.col(row) += inverse * (right_side.col(row) - row_times(matrix.matrix(), row, x));
}

/// Every unknown with its corner's number in lexicographic order, sorted by that; `layer` is how
/// many numbers a layer has.
std::vector<KeyValue> sorted_by_corner(const Level& level, std::uint64_t& layer) {
    const std::uint64_t side = (std::uint64_t{1} << static_cast<unsigned>(level.depth)) + 1;
    layer = side * side;
    std::vector<KeyValue> unknowns;
    resize(unknowns, level.unknown_count());
    serial_for(level.element_count(), [&](std::int64_t element) {
        const Cell cell = cell_at(level.cells[element]);
        for (int i = 0; i < 8; ++i) {
            const auto corner = corner_of(cell, i).cast<std::uint64_t>().eval();
            const auto unknown = static_cast<std::uint64_t>(level.unknowns[element][i]);
            unknowns[unknown] = {(corner[2] * side + corner[1]) * side + corner[0], unknown};
        }
    });
    sort_by_key(unknowns);
    return unknowns;
}

}  // namespace

GaussSeidel::GaussSeidel(const Level& level) {
    std::uint64_t layer = 0;
    const std::vector<KeyValue> unknowns = sorted_by_corner(level, layer);
    slab_begin_.push_back(0);
    serial_for(static_cast<std::int64_t>(unknowns.size()), [&](std::int64_t i) {
        order_.push_back(static_cast<std::int32_t>(unknowns[i].value));
        const bool new_layer = i > 0 && unknowns[i].key / layer != unknowns[i - 1].key / layer;
        if (new_layer && i - slab_begin_.back() >= kSmallestSlab) {
            slab_begin_.push_back(static_cast<std::int32_t>(i));
        }
    });
    slab_begin_.push_back(static_cast<std::int32_t>(order_.size()));
}

void GaussSeidel::sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const {
    sweep_half(matrix, right_side, x, 0);
    sweep_half(matrix, right_side, x, 1);
}

void GaussSeidel::sweep_half(const LevelMatrix& matrix, const Field& right_side, Field& x,
                             std::int64_t first_slab) const {
    const auto slabs = static_cast<std::int64_t>(slab_begin_.size()) - 1;
    parallel_for((slabs - first_slab + 1) / 2, [&](std::int64_t i) {
        const std::int64_t slab = first_slab + 2 * i;
        // The layers of a flat surface are few and large.
        serial_for(slab_begin_[slab], slab_begin_[slab + 1],
                   [&](std::int64_t place) { relax(matrix, right_side, x, order_[place]); });
    });
}

}  // namespace tracked_mcf
