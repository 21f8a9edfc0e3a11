// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/coarse_solver.h"

#include <Eigen/Eigenvalues>
#include <cstdint>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;

/// Eigenvalues below this fraction of the largest are rounding errors of single precision.
constexpr double kSingular = 1e-6;

Matrix8 pseudo_inverse(const Matrix8& matrix) {
    const Eigen::SelfAdjointEigenSolver<Matrix8> eigen(matrix);
    const double threshold = kSingular * eigen.eigenvalues().maxCoeff();
    const Eigen::Matrix<double, 8, 1> inverse = eigen.eigenvalues().unaryExpr(
        [&](double value) { return value > threshold && value > 0 ? 1 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void CoarseSolver::factorise(const MatrixBlocks& matrices) {
    pseudo_inverses_.resize(level_.unknowns.size());
    parallel_for_chunks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            Matrix8 matrix;
            for (int i = 0; i < 8; ++i) {
                for (int j = 0; j < 8; ++j) matrix(i, j) = double{matrices[element](i, j)};
            }
            pseudo_inverses_[element] = pseudo_inverse(matrix);
        }
    });
}

void CoarseSolver::solve(const Field& right_side, Field& x) const {
    x.resize(4, right_side.cols());
    parallel_for_rows(level_.element_count(), [&](std::int32_t element) {
        const auto& unknowns = level_.unknowns[element];
        Eigen::Matrix<float, 4, 8> at_corners;
        for (int i = 0; i < 8; ++i) at_corners.col(i) = right_side.col(unknowns[i]);
        at_corners = (at_corners.cast<double>() * pseudo_inverses_[element]).cast<float>();
        for (int i = 0; i < 8; ++i) x.col(unknowns[i]) = at_corners.col(i);
    });
}

}  // namespace tracked_mcf
