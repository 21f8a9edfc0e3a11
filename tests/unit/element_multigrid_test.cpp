#include "filter_tracked_mcf/core/element_multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "filter_tracked_mcf/core/element_products.h"
#include "filter_tracked_mcf/core/transfer.h"
#include "tests/support/shapes.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

using SparseDouble = Eigen::SparseMatrix<double>;

/// The sum of the finest level's element matrices.
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

Dense as_dense(const Field& field) {
    return field.cast<double>().transpose();
}

/// Two nearby sheets, so that there are unknowns at one corner.
TriangleMesh shells() {
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    return shapes::merged(sphere,
                          shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.97))));
}

TEST(ElementProducts, AreThoseOfTheAssembledMatrix) {
    const ElementSystem system(shells(), 6, 0.5F, {false, 0.01});  // in several parts
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

TEST(ElementProducts, SumElementVectors) {
    const ElementSystem system(shells(), 6, 0.5F);
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

TEST(ElementTransfer, IsTheProlongationAndItsTranspose) {
    const ElementSystem system(shells(), 4, 0.5F);
    for (std::size_t l = 1; l < system.elements.levels.size(); ++l) {
        const Level& fine = system.elements.levels[l];
        const Level& coarse = system.elements.levels[l - 1];
        const Dense p = dense(prolongation(fine, coarse));
        const ElementTransfer transfer(fine, coarse);

        const Field correction = Field::Random(4, coarse.unknown_count());
        std::vector<std::uint8_t> movable(static_cast<std::size_t>(fine.unknown_count()), 1);
        for (std::size_t i = 0; i < movable.size(); i += 3) movable[i] = 0;
        Field x = Field::Zero(4, fine.unknown_count());
        transfer.add_prolongated(correction, movable, x);
        Dense expected = p * as_dense(correction);
        for (std::size_t i = 0; i < movable.size(); i += 3) {
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

/// What a cycle leaves of an error, in the energy norm.
double error_left(int depth, float step) {
    ElementSystem system(shapes::geodesic_sphere(64), depth, step, {false, 0.01});
    const Field exact = random_field(system);
    Field right_side, x, product;
    const double before = system.multigrid.multiply(exact, right_side);
    system.multigrid.cycle(right_side, x);
    return std::sqrt(system.multigrid.multiply(exact - x, product) / before);
}

TEST(ElementMultigrid, ACycleReducesTheErrorIndependentlyOfDepthAndStep) {
    for (const int depth : {4, 5, 6}) {
        for (const float step : {1e-2F, 1.0F, 100.0F}) {
            EXPECT_LT(error_left(depth, step), 0.35) << depth << ' ' << step;
        }
    }
}

TEST(ElementMultigrid, LeavesFrozenUnknownsOut) {
    // Any unknowns, not only such as a boundary locks.
    ElementSystem system(shapes::bumpy_sphere(8), 4, 0.5F, {false, 0.01});
    std::vector<std::uint8_t>& frozen = system.multigrid.frozen();
    for (std::size_t i = 0; i < frozen.size(); i += 3) frozen[i] = 1;
    system.multigrid.refresh(system.systems.matrices, 0.5);
    system.multigrid.assemble(system.systems.right_sides, system.right_side);
    const Dense a = assembled(system);
    Field x;
    system.multigrid.cycle(system.right_side, x);
    for (std::size_t i = 0; i < frozen.size(); ++i) {
        const auto unknown = static_cast<std::int32_t>(i);
        EXPECT_EQ(system.multigrid.movable()[i] != 0, frozen[i] == 0);
        if (frozen[i] == 0) continue;
        EXPECT_TRUE(a.row(unknown).isZero(0) && a.col(unknown).isZero(0));
        EXPECT_TRUE(x.col(unknown).isZero(0));
        EXPECT_TRUE(system.right_side.col(unknown).isZero(0));
    }
}

}  // namespace
}  // namespace tracked_mcf
