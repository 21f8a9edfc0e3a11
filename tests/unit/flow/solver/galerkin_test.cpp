// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns the element matrices of the level below the finest one.
MatrixBlocks coarsened(const LevelSystem& system) {
    MatrixBlocks coarse;
    ElementTransfer(system.finest(), system.levels[system.levels.size() - 2])
        .coarsen(system.matrices, coarse);
    return coarse;
}

TEST(Galerkin, CoarsenedMatricesAddUpToTheGalerkinProduct) {
    const LevelSystem system = vertex_system(two_shells(), 4, 0.5);
    const Level& coarse = system.levels[3];
    const Dense p = prolongation(system.finest(), coarse);
    const Dense product = p.transpose() * assembled(system) * p;
    EXPECT_LT((assembled(coarse, coarsened(system)) - product).norm(), 1e-6 * product.norm());
}

TEST(Galerkin, EliminationSetsExactlyTheConstrainedRowsAndColumnsToZero) {
    LevelSystem system = vertex_system(two_shells(), 3, 0.5);
    Dense expected = assembled(system);
    std::vector<std::uint8_t> constrained(static_cast<std::size_t>(expected.rows()), 0);
    for (Eigen::Index unknown = 0; unknown < expected.rows(); unknown += 3) {
        constrained[unknown] = 1;
        expected.row(unknown).setZero();
        expected.col(unknown).setZero();
    }
    eliminate_constrained(system.finest(), constrained, system.matrices);
    EXPECT_EQ(assembled(system), expected);
}

TEST(Galerkin, AnUnknownIsFreeUnlessItsDiagonalEntryIsNegligible) {
    EXPECT_FALSE(is_free(0));
    EXPECT_FALSE(is_free(-1));
    EXPECT_FALSE(is_free(1e-31F));
    EXPECT_TRUE(is_free(1e-20F));
    EXPECT_TRUE(is_free(std::numeric_limits<float>::quiet_NaN()));  // so that it propagates
}

}  // namespace
}  // namespace tracked_mcf
