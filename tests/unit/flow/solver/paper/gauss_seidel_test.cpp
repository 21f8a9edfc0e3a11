// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/gauss_seidel.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns the unknowns in the lexicographic order of their corners, z slowest.
std::vector<std::int32_t> lexicographic_order(const TrackedElements& elements) {
    const Coefficients corners = identity_coefficients(elements);
    std::vector<std::int32_t> order(static_cast<std::size_t>(corners.rows()));
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::int32_t unknown) {
        return std::tuple(corners(unknown, 2), corners(unknown, 1), corners(unknown, 0), unknown);
    };
    std::sort(order.begin(), order.end(),
              [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    return order;
}

TEST(GaussSeidel, ASweepIsAForwardSubstitution) {
    // The level is small enough for one slab, so a sweep is (D + L)⁻¹ (b - U x) in this order.
    const System system(shapes::bumpy_sphere(6), 3, 0.5F);
    const std::vector<std::int32_t> order = lexicographic_order(system.elements);
    const Dense unordered = dense(system.multigrid.finest().matrix());
    const Dense a = unordered(order, order);
    Field x = random_field(system.elements.finest());
    const Dense b = as_dense(system.right_side)(order, Eigen::all);
    const Dense upper = a.triangularView<Eigen::StrictlyUpper>();
    const Dense start = as_dense(x)(order, Eigen::all);
    const Dense expected = a.triangularView<Eigen::Lower>().solve(b - upper * start);
    GaussSeidel(system.elements.finest()).sweep(system.multigrid.finest(), system.right_side, x);
    // Coefficients of functions that hardly meet the surface are large and ill conditioned, so
    // compare products with the matrix.
    const Dense difference = a * (as_dense(x)(order, Eigen::all) - expected);
    EXPECT_LT(difference.norm(), 1e-5 * (a * expected).norm());
}

TEST(GaussSeidel, ASweepHasTheSameBitsWithAnyNumberOfThreads) {
    const System system(shapes::bumpy_sphere(40), 6, 0.5F);
    ASSERT_GT(system.elements.finest().unknown_count(), 2 * 8192);  // several slabs
    const GaussSeidel gauss_seidel(system.elements.finest());
    const Field start = random_field(system.elements.finest());
    std::vector<Field> results;
    for (const int count : {1, 2, 3, 8}) {
        const ThreadTeam threads(count);
        results.push_back(start);
        gauss_seidel.sweep(system.multigrid.finest(), system.right_side, results.back());
        EXPECT_EQ(results.back(), results.front());
    }
}

}  // namespace
}  // namespace tracked_mcf
