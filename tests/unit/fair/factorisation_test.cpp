// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/factorisation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <string_view>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {
namespace {

/// Returns the Laplacian of a grid of n x n points, plus `shift` times the identity.
Eigen::SparseMatrix<double> laplacian(int n, double shift) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto link = [&](int a, int b) {
        entries.insert(entries.end(), {{a, a, 1}, {b, b, 1}, {a, b, -1}, {b, a, -1}});
    };
    for (int i = 0; i < n * n; ++i) {
        entries.emplace_back(i, i, shift);
        if (i % n > 0) link(i, i - 1);
        if (i >= n) link(i, i - n);
    }
    Eigen::SparseMatrix<double> matrix(n * n, n * n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

TEST(Factorisation, Solves) {
    Factorisation factors;
    const Eigen::SparseMatrix<double> first = laplacian(12, 0.1);
    factors.analyse(first);
    const Factorisation::Points b = Factorisation::Points::Random(first.rows(), 3);
    for (const double shift : {0.1, 5.0}) {
        const Eigen::SparseMatrix<double> matrix = laplacian(12, shift);
        ASSERT_TRUE(factors.factorise(matrix));
        const Eigen::MatrixXd expected = Eigen::MatrixXd(matrix).llt().solve(b);
        EXPECT_LT((factors.solve(b) - expected).cwiseAbs().maxCoeff(), 1e-12) << shift;
    }
}

TEST(Factorisation, TellsMatricesThatAreNotPositiveDefinite) {
    Factorisation factors;
    factors.analyse(laplacian(12, -1));
    EXPECT_FALSE(factors.factorise(laplacian(12, -1)));
    EXPECT_FALSE(factors.factorise(laplacian(12, std::nan(""))));
    EXPECT_TRUE(factors.factorise(laplacian(12, 1)));
}

TEST(Factorisation, PollsAtEveryRow) {
    const Eigen::SparseMatrix<double> matrix = laplacian(12, 1);
    int calls = 0;
    const Progress progress = [&](double, std::string_view) { return ++calls < 1000; };
    const ProgressMeter meter(progress, ProgressMeter::Clock::duration::zero());
    const auto calls_of = [&](const auto& work) {
        calls = 0;
        work();
        return calls;
    };
    Factorisation factors;
    const Factorisation::Points b = Factorisation::Points::Ones(matrix.rows(), 3);
    EXPECT_GE(calls_of([&] { factors.analyse(matrix); }), matrix.rows());
    EXPECT_GE(calls_of([&] { factors.factorise(matrix); }), matrix.rows());
    EXPECT_GE(calls_of([&] { factors.solve(b); }), matrix.rows());
    calls = 900;
    EXPECT_THROW(factors.factorise(matrix), Cancelled);
}

}  // namespace
}  // namespace tracked_mcf
