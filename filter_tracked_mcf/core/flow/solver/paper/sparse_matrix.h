// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/solver/field.h"

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

}  // namespace tracked_mcf
