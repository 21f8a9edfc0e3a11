#include "filter_tracked_mcf/core/coarse_solver.h"

#include <Eigen/Eigenvalues>
#include <cstdint>

#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Eigenvalues below this fraction of the largest are rounding errors of single precision.
constexpr double kSingular = 1e-6;

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    const Eigen::VectorXd& values = eigen.eigenvalues();
    const double threshold = kSingular * values.maxCoeff();
    const Eigen::VectorXd inverse = values.unaryExpr(
        [&](double value) { return value > threshold && value > 0 ? 1 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void CoarseSolver::factorise(const MatrixBlocks& matrices) {
    pseudo_inverses_.resize(level_.unknowns.size());
    parallel_for_blocks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            const ElementMatrix whole = matrices.of(element);
            const Eigen::Map<const Eigen::Matrix<float, 8, 8>> matrix(whole.entry[0]);
            pseudo_inverses_[element] = pseudo_inverse(matrix.cast<double>());
        }
    });
}

void CoarseSolver::solve(const Field& right_side, Field& x) const {
    x.resize(4, right_side.cols());
    parallel_for_rows(level_.element_count(), [&](std::int32_t element) {
        const auto& unknowns = level_.unknowns[element];
        Field part(4, 8);
        for (int i = 0; i < 8; ++i) part.col(i) = right_side.col(unknowns[i]);
        part = (part.cast<double>() * pseudo_inverses_[element]).cast<float>();
        for (int i = 0; i < 8; ++i) x.col(unknowns[i]) = part.col(i);
    });
}

}  // namespace tracked_mcf
