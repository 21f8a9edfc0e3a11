// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

using SparseMatrix = Eigen::SparseMatrix<float, Eigen::RowMajor, std::int32_t>;

/// Returns row `row` of matrix * x.
inline Eigen::Vector4f row_times(const SparseMatrix& matrix, std::int32_t row, const Field& x) {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    const std::int32_t end = matrix.outerIndexPtr()[row + 1];
    for (std::int32_t k = matrix.outerIndexPtr()[row]; k < end; ++k) {
        sum += matrix.valuePtr()[k] * x.col(matrix.innerIndexPtr()[k]);
    }
    return sum;
}

/// A level's system matrix. The pattern follows from the octree and is made once; each step sets
/// the values from element matrices. Each row is summed in a fixed order: the bits are the same at
/// any number of threads.
class LevelMatrix {
public:
    /// Makes the pattern of `level`, which must outlive this. The values are not set.
    explicit LevelMatrix(const Level& level);

    /// Sums the level's element matrices. The inverse diagonal becomes 0 for unknowns that are not
    /// free, so that no smoother changes them: constrained ones, and those to whose diagonal no
    /// sample contributes.
    void assemble(const MatrixBlocks& elements, const std::vector<std::uint8_t>& constrained);

    const SparseMatrix& matrix() const { return matrix_; }
    const std::vector<float>& inverse_diagonal() const { return inverse_diagonal_; }
    /// Returns for each unknown whether it is free (not 0).
    const std::vector<std::uint8_t>& free_unknowns() const { return free_unknowns_; }

    /// Computes residual = right_side - A x, zero for unknowns that are not free.
    void residual(const Field& right_side, const Field& x, Field& residual) const;

private:
    void make_pattern();
    void assemble_row(std::int32_t row, const MatrixBlocks& elements,
                      std::vector<float>& sums) const;
    void store_row(std::int32_t row, std::vector<float>& sums);

    const Level& level_;
    SparseMatrix matrix_;
    std::vector<float> inverse_diagonal_;
    std::vector<std::uint8_t> free_unknowns_;
};

}  // namespace tracked_mcf
