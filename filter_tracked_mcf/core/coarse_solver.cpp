#include "filter_tracked_mcf/core/coarse_solver.h"

#include <Eigen/Eigenvalues>

namespace tracked_mcf {

namespace {

/// Eigenvalues below this fraction of the largest are rounding errors of single precision.
constexpr double kSingular = 1e-6;

/// The matrix with the rows and columns of unknowns that may not move left out (set to zero).
Eigen::MatrixXd movable_part(const LevelMatrix& matrix) {
    Eigen::MatrixXd dense = Eigen::MatrixXf(matrix.matrix()).cast<double>();
    for (Eigen::Index i = 0; i < dense.rows(); ++i) {
        if (matrix.inverse_diagonal()[i] != 0) continue;
        dense.row(i).setZero();
        dense.col(i).setZero();
    }
    return dense;
}

}  // namespace

void CoarseSolver::factorise(const LevelMatrix& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(movable_part(matrix));
    const Eigen::VectorXd& values = eigen.eigenvalues();
    const double threshold = kSingular * values.maxCoeff();
    const Eigen::VectorXd inverse = values.unaryExpr(
        [&](double value) { return value > threshold && value > 0 ? 1 / value : 0.0; });
    pseudo_inverse_ =
        eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

void CoarseSolver::solve(const Field& right_side, Field& x) const {
    x = (right_side.cast<double>() * pseudo_inverse_).cast<float>();
}

}  // namespace tracked_mcf
