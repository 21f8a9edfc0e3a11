// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"

#include <gtest/gtest.h>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

TEST(ElementTransfer, EqualsTheProlongationMatrixAndItsTranspose) {
    const LevelSystem system = vertex_system(two_shells(), 4, 0.5);
    for (std::size_t l = 1; l < system.levels.size(); ++l) {
        const Level& fine = system.levels[l];
        const Level& coarse = system.levels[l - 1];
        const Dense p = prolongation(fine, coarse);
        const ElementTransfer transfer(fine, coarse);

        const Field correction = Field::Random(4, coarse.unknown_count());
        std::vector<std::uint8_t> free_unknowns(static_cast<std::size_t>(fine.unknown_count()), 1);
        for (std::size_t i = 0; i < free_unknowns.size(); i += 3) free_unknowns[i] = 0;
        Field x = Field::Zero(4, fine.unknown_count());
        transfer.add_prolongated(correction, free_unknowns, x);
        Dense expected = p * as_dense(correction);
        for (std::size_t i = 0; i < free_unknowns.size(); i += 3) {
            expected.row(static_cast<Eigen::Index>(i)).setZero();
        }
        EXPECT_LT((as_dense(x) - expected).norm(), 1e-6 * expected.norm());

        const Field residual = Field::Random(4, fine.unknown_count());
        Field restricted;
        transfer.restrict(residual, ElementPartition(coarse), restricted);
        const Dense transposed = p.transpose() * as_dense(residual);
        EXPECT_LT((as_dense(restricted) - transposed).norm(), 1e-6 * transposed.norm());
    }
}

}  // namespace
}  // namespace tracked_mcf
