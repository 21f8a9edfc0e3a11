// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// The factorisation P K Pᵀ = L D Lᵀ of a symmetric positive definite sparse matrix K, with a
/// permutation P that keeps L sparse. Unlike Eigen's, it polls progress at every row, so it can be
/// cancelled.
class Factorisation {
public:
    using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

    /// Chooses P and the places of L's entries for matrices with the entries of `matrix`.
    void analyse(const Eigen::SparseMatrix<double>& matrix);

    /// Finds L and D. Returns false if a pivot is not positive. Throws Cancelled.
    bool factorise(const Eigen::SparseMatrix<double>& matrix);

    /// Returns K⁻¹ b. Throws Cancelled.
    Points solve(const Points& b) const;

private:
    Eigen::SparseMatrix<double> permuted(const Eigen::SparseMatrix<double>& matrix) const;

    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation_;
    std::vector<int> parents_;         ///< of the rows in the elimination tree, -1 for roots
    std::vector<std::int64_t> begin_;  ///< of the entries of L's columns below the diagonal
    std::vector<int> rows_;            ///< of L's entries
    std::vector<double> values_, pivots_;
};

}  // namespace tracked_mcf
