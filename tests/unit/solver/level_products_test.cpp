// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/level_products.h"

#include <gtest/gtest.h>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

using SparseDouble = Eigen::SparseMatrix<double>;

/// Returns the sum of the finest level's element matrices.
SparseDouble sparse(const FirstStep& step) {
    const Level& finest = step.elements.finest();
    std::vector<Eigen::Triplet<double>> entries;
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        const auto& unknowns = finest.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                entries.emplace_back(unknowns[i], unknowns[j],
                                     step.systems.matrices.at(element, i, j));
            }
        }
    }
    SparseDouble sum(finest.unknown_count(), finest.unknown_count());
    sum.setFromTriplets(entries.begin(), entries.end());
    return sum;
}

TEST(ElementProducts, EqualThoseOfTheAssembledMatrix) {
    const ElementSystem system(two_shells(), 6, 0.5F, {false, 0.01});  // in several parts
    const SparseDouble a = sparse(system);
    EXPECT_GT(system.elements.finest().element_count(), 2 * 4096);
    const Field x = random_field(system), b = random_field(system);
    const Dense expected = a * as_dense(x);

    Field product;
    const double dot = system.multigrid.multiply(x, product);
    EXPECT_LT((as_dense(product) - expected).norm(), 1e-6 * expected.norm());
    EXPECT_NEAR(dot, expected.cwiseProduct(as_dense(x)).sum(), 1e-6 * dot);

    Field residual;
    subtract_products(ElementPartition(system.elements.finest()), system.systems.matrices, b, x,
                      residual);
    EXPECT_LT((as_dense(residual) - (as_dense(b) - expected)).norm(), 1e-6 * expected.norm());

    const Coefficients precise = as_dense(x).leftCols(3);
    system.multigrid.residual(b, precise, residual);
    EXPECT_LT((as_dense(residual) - (as_dense(b) - expected)).norm(), 1e-7 * expected.norm());
}

TEST(ElementProducts, SumVectorsOfAllElements) {
    const ElementSystem system(two_shells(), 6, 0.5F);
    const Level& finest = system.elements.finest();
    Dense expected = Dense::Zero(finest.unknown_count(), 4);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        for (int i = 0; i < 8; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                expected(finest.unknowns[element][i], axis) +=
                    system.systems.right_sides[element].entry[axis][i];
            }
        }
    }
    EXPECT_LT((as_dense(system.right_side) - expected).norm(), 1e-6 * expected.norm());
}

}  // namespace
}  // namespace tracked_mcf
