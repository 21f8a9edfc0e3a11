// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/factorisation.h"

#include <Eigen/OrderingMethods>
#include <numeric>

#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

using ColumnMatrix = Eigen::SparseMatrix<double>;
using Entry = ColumnMatrix::InnerIterator;

}  // namespace

/// Returns the upper triangle of P K Pᵀ.
ColumnMatrix Factorisation::permuted(const ColumnMatrix& matrix) const {
    ColumnMatrix upper(matrix.rows(), matrix.cols());
    upper.selfadjointView<Eigen::Upper>() =
        matrix.selfadjointView<Eigen::Upper>().twistedBy(permutation_);
    return upper;
}

void Factorisation::analyse(const ColumnMatrix& matrix) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
    Eigen::AMDOrdering<int>()(matrix, inverse);
    poll_progress();
    permutation_ = inverse.inverse();
    const ColumnMatrix upper = permuted(matrix);
    const auto count = static_cast<int>(matrix.cols());
    parents_.assign(count, -1);
    begin_.assign(count + std::size_t{1}, 0);
    std::vector<int> visited(count);
    for (int row = 0; row < count; ++row) {
        poll_progress();
        visited[row] = row;
        for (Entry entry(upper, row); entry; ++entry) {
            for (auto i = static_cast<int>(entry.row()); visited[i] != row; i = parents_[i]) {
                if (parents_[i] < 0) parents_[i] = row;
                ++begin_[i + 1];
                visited[i] = row;
            }
        }
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
}

/// Finds L row by row: a row's entries are at the rows on the paths from the matrix's entries to
/// the root of the elimination tree (T. A. Davis, Algorithm 849, ACM TOMS 31, 2005).
bool Factorisation::factorise(const ColumnMatrix& matrix) {
    const ColumnMatrix upper = permuted(matrix);
    const auto count = static_cast<int>(matrix.cols());
    rows_.resize(begin_.back());
    values_.resize(begin_.back());
    pivots_.assign(count, 0);
    std::vector<std::int64_t> end(begin_.begin(), begin_.end() - 1);
    std::vector<int> visited(count), pattern(count);
    std::vector<double> dense(count, 0);
    for (int row = 0; row < count; ++row) {
        poll_progress();
        visited[row] = row;
        int top = count;
        for (Entry entry(upper, row); entry; ++entry) {
            auto i = static_cast<int>(entry.row());
            dense[i] += entry.value();
            int length = 0;
            for (; visited[i] != row; i = parents_[i]) {
                pattern[length++] = i;
                visited[i] = row;
            }
            while (length > 0) pattern[--top] = pattern[--length];
        }
        double pivot = dense[row];
        dense[row] = 0;
        for (; top < count; ++top) {
            const int column = pattern[top];
            const double value = dense[column];
            dense[column] = 0;
            for (std::int64_t k = begin_[column]; k < end[column]; ++k)
                dense[rows_[k]] -= values_[k] * value;
            const std::int64_t added = end[column]++;
            rows_[added] = row;
            values_[added] = value / pivots_[column];
            pivot -= values_[added] * value;
        }
        if (!(pivot > 0)) return false;
        pivots_[row] = pivot;
    }
    return true;
}

Factorisation::Points Factorisation::solve(const Points& b) const {
    Points x = permutation_ * b;
    const auto count = static_cast<int>(x.rows());
    for (int i = 0; i < count; ++i) {
        poll_progress();
        for (std::int64_t k = begin_[i]; k < begin_[i + std::size_t{1}]; ++k)
            x.row(rows_[k]) -= values_[k] * x.row(i);
    }
    for (int i = 0; i < count; ++i) x.row(i) /= pivots_[i];
    for (int i = count - 1; i >= 0; --i) {
        poll_progress();
        for (std::int64_t k = begin_[i]; k < begin_[i + std::size_t{1}]; ++k)
            x.row(i) -= values_[k] * x.row(rows_[k]);
    }
    return permutation_.inverse() * x;
}

}  // namespace tracked_mcf
