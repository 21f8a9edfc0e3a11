// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/coarse_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns a random symmetric positive semi-definite matrix of this rank, of whole numbers, so that
/// single precision is exact.
Dense random_matrix(int rank) {
    const Dense factor = (8 * Dense::Random(8, rank)).array().round();
    return factor * factor.transpose();
}

TEST(CoarseSolver, ReturnsTheLeastSquaresSolutionOfLeastNormForEachComponent) {
    // Three components: a regular, a singular and a zero matrix.
    constexpr int ranks[] = {8, 5, 0};
    Level level;
    level.cells.resize(3);
    level.number_of_unknowns = 24;
    MatrixBlocks matrices(3);
    for (std::int32_t element = 0; element < 3; ++element) {
        const Dense matrix = random_matrix(ranks[element]);
        level.unknowns.emplace_back();
        for (int i = 0; i < 8; ++i) {
            level.unknowns[element][i] = 8 * element + (3 * i + 5) % 8;
            for (int j = i; j < 8; ++j) {
                matrices[element](i, j) = static_cast<float>(matrix(i, j));
            }
        }
    }
    CoarseSolver solver(level);
    solver.factorise(matrices);
    const Field right_side = Field::Random(4, 24);
    Field x;
    solver.solve(right_side, x);

    Eigen::CompleteOrthogonalDecomposition<Dense> decomposition;
    decomposition.setThreshold(1e-10);
    const Dense least =
        decomposition.compute(assembled(level, matrices)).solve(as_dense(right_side));
    EXPECT_LT((as_dense(x) - least).norm(), 1e-4 * least.norm());
    EXPECT_TRUE(x.rightCols(8).isZero(0));
}

TEST(CoarseSolver, SolvesASingularSystemInTheLeastSquaresSense) {
    // A flat patch in a grid plane: the four functions off the plane have zero rows.
    const System system(shapes::square(4), 1, 0.5F);
    MatrixBlocks coarsest;
    ElementTransfer(system.elements.levels[1], system.elements.levels[0])
        .coarsen(system.systems.matrices, coarsest);
    CoarseSolver solver(system.elements.levels[0]);
    solver.factorise(coarsest);
    const Dense a = assembled(system.elements.levels[0], coarsest);
    const Field exact = Field::Random(4, a.rows());
    const Field b = (a * exact.cast<double>().transpose()).transpose().cast<float>();
    Field x;
    solver.solve(b, x);
    EXPECT_TRUE(x.allFinite());
    EXPECT_LT((a * as_dense(x) - as_dense(b)).norm(), 1e-4 * b.norm());
}

}  // namespace
}  // namespace tracked_mcf
