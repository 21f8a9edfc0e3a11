// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/level_matrix.h"

#include <algorithm>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

LevelMatrix::LevelMatrix(const Level& level)
    : level_(level), matrix_(level.unknown_count(), level.unknown_count()) {
    make_pattern();
}

void LevelMatrix::make_pattern() {
    const std::int32_t count = level_.unknown_count();
    std::vector<std::int32_t> row_size(static_cast<std::size_t>(count));
    const auto columns = parallel_collect<std::int32_t>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<std::int32_t>& out) {
            for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
                const auto first = static_cast<std::ptrdiff_t>(out.size());
                for (const std::int32_t index : level_.corners.members(row)) {
                    const auto& unknowns = level_.unknowns[index / 8];
                    out.insert(out.end(), unknowns.begin(), unknowns.end());
                }
                std::sort(out.begin() + first, out.end());
                out.erase(std::unique(out.begin() + first, out.end()), out.end());
                row_size[row] =
                    static_cast<std::int32_t>(out.size()) - static_cast<std::int32_t>(first);
            }
        });
    if (columns.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw InvalidParameter("The octree is too deep for this mesh; choose a smaller depth.");
    }
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(columns.size()));
    std::int32_t* const row_begin = matrix_.outerIndexPtr();
    row_begin[0] = 0;
    for (std::int32_t row = 0; row < count; ++row)
        row_begin[row + 1] = row_begin[row] + row_size[row];
    parallel_for_chunks(static_cast<std::int64_t>(columns.size()), [&](std::int64_t begin,
                                                                       std::int64_t end) {
        std::copy(columns.begin() + begin, columns.begin() + end, matrix_.innerIndexPtr() + begin);
    });
}

void LevelMatrix::assemble(const MatrixBlocks& elements,
                           const std::vector<std::uint8_t>& constrained) {
    inverse_diagonal_.resize(static_cast<std::size_t>(level_.unknown_count()));
    free_unknowns_.resize(inverse_diagonal_.size());
    // A workspace for the entries of a row, one number per unknown.
    const auto no_sums = [&] {
        return std::vector<float>(static_cast<std::size_t>(level_.unknown_count()), 0.0F);
    };
    const auto assemble_rows = [&](std::vector<float>& sums, std::int64_t begin, std::int64_t end) {
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
            assemble_row(row, elements, sums);
            const bool free = constrained[row] == 0 && is_free(sums[row]);
            free_unknowns_[row] = free ? 1 : 0;
            inverse_diagonal_[row] = free ? 1 / sums[row] : 0;
            store_row(row, sums);
        }
    };
    parallel_for_chunks_with(level_.unknown_count(), no_sums, assemble_rows);
}

void LevelMatrix::assemble_row(std::int32_t row, const MatrixBlocks& elements,
                               std::vector<float>& sums) const {
    for (const std::int32_t index : level_.corners.members(row)) {
        const std::int32_t element = index / 8;
        const auto& unknowns = level_.unknowns[element];
        for (int corner = 0; corner < 8; ++corner) {
            sums[unknowns[corner]] += elements[element](index % 8, corner);
        }
    }
}

void LevelMatrix::store_row(std::int32_t row, std::vector<float>& sums) {
    const std::int32_t end = matrix_.outerIndexPtr()[row + 1];
    for (std::int32_t k = matrix_.outerIndexPtr()[row]; k < end; ++k) {
        float& sum = sums[matrix_.innerIndexPtr()[k]];
        matrix_.valuePtr()[k] = sum;
        sum = 0;
    }
}

void LevelMatrix::residual(const Field& right_side, const Field& x, Field& residual) const {
    residual.resize(4, level_.unknown_count());
    parallel_for_rows(level_.unknown_count(), [&](std::int32_t row) {
        if (free_unknowns_[row] == 0) {
            residual.col(row).setZero();
        } else {
            residual.col(row) = right_side.col(row) - row_times(matrix_, row, x);
        }
    });
}

}  // namespace tracked_mcf
