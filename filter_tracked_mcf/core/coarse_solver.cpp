#include "filter_tracked_mcf/core/coarse_solver.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cstdint>

#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Eigenvalues below this fraction of the largest are rounding errors of single precision.
constexpr double kSingular = 1e-6;

using Unknowns = std::array<std::int32_t, 8>;

/// The matrix of an element's unknowns, with the rows and columns of those that may not move left
/// out (set to zero).
Eigen::MatrixXd movable_part(const LevelMatrix& matrix, const Unknowns& unknowns) {
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(8, 8);
    for (int i = 0; i < 8; ++i) {
        if (matrix.inverse_diagonal()[unknowns[i]] == 0) continue;
        for (int j = 0; j < 8; ++j) {
            if (matrix.inverse_diagonal()[unknowns[j]] == 0) continue;
            part(i, j) = matrix.matrix().coeff(unknowns[i], unknowns[j]);
        }
    }
    return part;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    const Eigen::VectorXd& values = eigen.eigenvalues();
    const double threshold = kSingular * values.maxCoeff();
    const Eigen::VectorXd inverse = values.unaryExpr(
        [&](double value) { return value > threshold && value > 0 ? 1 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void CoarseSolver::factorise(const LevelMatrix& matrix) {
    pseudo_inverses_.resize(level_.unknowns.size());
    parallel_for_blocks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            pseudo_inverses_[element] =
                pseudo_inverse(movable_part(matrix, level_.unknowns[element]));
        }
    });
}

void CoarseSolver::solve(const Field& right_side, Field& x) const {
    x.resize(4, right_side.cols());
    parallel_for_rows(level_.element_count(), [&](std::int32_t element) {
        const Unknowns& unknowns = level_.unknowns[element];
        Field part(4, 8);
        for (int i = 0; i < 8; ++i) part.col(i) = right_side.col(unknowns[i]);
        part = (part.cast<double>() * pseudo_inverses_[element]).cast<float>();
        for (int i = 0; i < 8; ++i) x.col(unknowns[i]) = part.col(i);
    });
}

}  // namespace tracked_mcf
