// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/element_transfer.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/solver/paper/transfer.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns the element matrices of the level below the finest one.
MatrixBlocks coarsened(const FirstStep& step) {
    const Level& fine = step.elements.finest();
    const std::int32_t parents = step.elements.levels[fine.depth - 1].element_count();
    MatrixBlocks coarse(parents);
    coarsen_element_matrices(fine, Groups(fine.parents, parents), step.systems.matrices, coarse);
    return coarse;
}

TEST(Galerkin, CoarsenedMatricesAddUpToTheGalerkinProduct) {
    const FirstStep step(two_shells(), 4, 0.5F, {});
    const Level& coarse = step.elements.levels[3];
    const Dense p = dense(prolongation(step.elements.finest(), coarse));
    const Dense product = p.transpose() * assembled(step) * p;
    EXPECT_LT((assembled(coarse, coarsened(step)) - product).norm(), 1e-6 * product.norm());
}

TEST(Galerkin, EliminationSetsExactlyTheConstrainedRowsAndColumnsToZero) {
    FirstStep step(two_shells(), 3, 0.5F, {});
    Dense expected = assembled(step);
    std::vector<std::uint8_t> constrained(static_cast<std::size_t>(expected.rows()), 0);
    for (Eigen::Index unknown = 0; unknown < expected.rows(); unknown += 3) {
        constrained[unknown] = 1;
        expected.row(unknown).setZero();
        expected.col(unknown).setZero();
    }
    eliminate_constrained(step.elements.finest(), constrained, step.systems.matrices);
    EXPECT_EQ(assembled(step), expected);
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
