#include "filter_tracked_mcf/core/gauss_seidel.h"

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Large enough that few unknowns lie at a cut, small enough to share among many threads.
constexpr std::int32_t kSmallestSlab = 8192;

void relax(const LevelMatrix& matrix, const Field& right_side, Field& x, std::int32_t row) {
    const float inverse = matrix.inverse_diagonal()[row];
    if (inverse == 0) return;
    x.col(row) += inverse * (right_side.col(row) - row_times(matrix.matrix(), row, x));
}

}  // namespace

GaussSeidel::GaussSeidel(const Level& level) {
    slab_begin_.push_back(0);
    const std::int32_t count = level.unknown_count();
    for (std::int32_t unknown = kSmallestSlab; unknown < count; ++unknown) {
        const bool new_layer = level.layers[unknown] != level.layers[unknown - 1];
        if (new_layer && unknown - slab_begin_.back() >= kSmallestSlab) {
            slab_begin_.push_back(unknown);
        }
    }
    slab_begin_.push_back(count);
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
        serial_for(slab_begin_[slab], slab_begin_[slab + 1], [&](std::int64_t row) {
            relax(matrix, right_side, x, static_cast<std::int32_t>(row));
        });
    });
}

}  // namespace tracked_mcf
