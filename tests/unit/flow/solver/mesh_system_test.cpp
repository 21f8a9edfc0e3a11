// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/mesh_system.h"

namespace tracked_mcf {
namespace {

constexpr double kStepOfSystem = 3;       ///< squared edges
constexpr double kSingleRounding = 1e-6;  ///< of sums of some products, relative

/// A surface and its system. It has 1442 vertices, so two chunks, or a part of these.
struct SystemOfMesh {
    explicit SystemOfMesh(const TriangleMesh& mesh,
                          BoundaryCondition boundary = BoundaryCondition::Free)
        : surface(surface_of(mesh, {}, boundary)),
          elements(elements_of(surface)),
          system(surface.stars, surface.held, surface.parts) {
        system.take(elements, kStepOfSystem);
    }
    SystemOfMesh(const SystemOfMesh&) = delete;
    SystemOfMesh& operator=(const SystemOfMesh&) = delete;

    Eigen::MatrixXd dense() const {
        return dense_mass(surface.stars, elements) +
               kStepOfSystem * dense_stiffness(surface.stars, elements);
    }
    Field zero() const { return Field::Zero(4, surface.stars.count()); }
    /// Returns A x.
    Field product(const Field& x) const {
        Field p = zero(), q = zero();
        advance(system, x, 0, p, q);
        return q;
    }

    Surface surface;
    TriangleElements elements;
    MeshSystem system;
};

TriangleMesh closed_mesh() {
    return shapes::bumpy_sphere(12);
}

void expect_close(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                  double tolerance = kSingleRounding) {
    EXPECT_LE((a - b).norm(), tolerance * b.norm());
}

/// Returns a surface of the same triangles, squeezed.
Surface squeezed(Surface surface) {
    for (Eigen::Vector3d& position : surface.positions) {
        position = position.cwiseProduct(Eigen::Vector3d(1, 0.7, 0.4));
    }
    return surface;
}

TEST(MeshSystem, MultipliesLikeADenseMatrix) {
    const SystemOfMesh of(closed_mesh());
    const Eigen::MatrixXd a = of.dense();
    const Field first = random_at_vertices(of.surface, 1),
                second = random_at_vertices(of.surface, 2);
    Field p = of.zero(), q = of.zero();
    double energy = advance(of.system, first, 0, p, q);
    EXPECT_EQ(p, first);
    expect_close(rows_of(q), a * rows_of(first));
    EXPECT_NEAR(energy, rows_of(first).cwiseProduct(a * rows_of(first)).sum(),
                kSingleRounding * energy);

    energy = advance(of.system, second, 0.5F, p, q);
    const Field sum = second + 0.5F * first;
    EXPECT_EQ(p, sum);
    expect_close(rows_of(q), a * rows_of(sum));
    EXPECT_NEAR(energy, rows_of(sum).cwiseProduct(a * rows_of(sum)).sum(),
                kSingleRounding * energy);
}

TEST(MeshSystem, MultipliesConstantsByTheLumpedMass) {
    const SystemOfMesh of(closed_mesh());
    const Field product = of.product(Field::Constant(4, of.surface.stars.count(), 1));
    double sum = 0, area = 0;
    for (std::int32_t vertex = 0; vertex < of.surface.stars.count(); ++vertex) {
        // The diagonal is about 6 δ / √3 = 10, and the mass is about 1.
        EXPECT_NEAR(product(0, vertex), of.system.mass(vertex), 1e-5);
        sum += double{of.system.mass(vertex)};
    }
    for (const TriangleElement<float>& element : of.elements) area += 3 * double{element.mass};
    EXPECT_NEAR(sum, area, kSingleRounding * area);
}

TEST(MeshSystem, StiffnessOfConstantsIsExactlyZero) {
    const SystemOfMesh of(closed_mesh());
    const std::vector<Eigen::Vector3d> constant(of.surface.positions.size(), {1e6 / 3, -2.7, 5});
    Field product;
    of.system.multiply_stiffness(constant, 1, product);
    EXPECT_TRUE(product.isZero(0));
}

TEST(MeshSystem, StiffnessIsThatOfADenseMatrixAndDoesNotSeeWhereTheSurfaceIs) {
    const SystemOfMesh of(closed_mesh());
    Field product, moved_product;
    of.system.multiply_stiffness(of.surface.positions, -2, product);
    expect_close(rows_of(product), -2 * kStepOfSystem *
                                       dense_stiffness(of.surface.stars, of.elements) *
                                       rows_of(of.surface.positions));
    std::vector<Eigen::Vector3d> moved = of.surface.positions;
    for (Eigen::Vector3d& position : moved) position += Eigen::Vector3d(1e6, -1e6, 1e6);
    of.system.multiply_stiffness(moved, -2, moved_product);
    // Single precision of the coordinates themselves would lose all digits.
    expect_close(rows_of(moved_product), rows_of(product));
}

TEST(MeshSystem, ResidualIsThatOfADenseMatrix) {
    const SystemOfMesh of(closed_mesh());
    const Eigen::MatrixXd a = of.dense();
    const Field b = random_at_vertices(of.surface, 1);
    expect_close(rows_of(residual_of(of.system, b, of.surface.positions)),
                 rows_of(b) - a * rows_of(of.surface.positions));

    const Eigen::MatrixXd solution = a.llt().solve(rows_of(b));
    std::vector<Eigen::Vector3d> x(of.surface.positions.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = solution.row(static_cast<Eigen::Index>(i)).transpose();
    }
    EXPECT_LT(norm(residual_of(of.system, b, x)), kSingleRounding * norm(b));
}

TEST(MeshSystem, KeepsZeroRowsAtVerticesThatStay) {
    const SystemOfMesh of(bumpy_cap(12), BoundaryCondition::Locked);
    ASSERT_GT(std::count(of.surface.held.begin(), of.surface.held.end(), 1), 10);
    const Eigen::MatrixXd a = of.dense();
    const Field x = random_at_vertices(of.surface, 1);
    // A right-hand side that is not zero at vertices that stay must not matter.
    const Field everywhere = Field::Constant(4, of.surface.stars.count(), 1);
    Field product, z = of.zero();
    of.system.multiply_stiffness(of.surface.positions, 1, product);
    const Field residual = residual_of(of.system, everywhere, of.surface.positions);
    of.system.relax(of.system.blocks()[0], everywhere, z);
    const Field multiplied = of.product(x);
    for (std::int32_t vertex = 0; vertex < of.surface.stars.count(); ++vertex) {
        if (of.surface.held[vertex] == 0) continue;
        EXPECT_TRUE(of.system.is_held(vertex));
        for (const Field& field : {product, residual, z, multiplied}) {
            EXPECT_TRUE(field.col(vertex).isZero(0));
        }
    }
    expect_close(rows_of(multiplied), without_held_rows(of.surface, a * rows_of(x)));
    expect_close(
        rows_of(residual),
        without_held_rows(of.surface, rows_of(everywhere) - a * rows_of(of.surface.positions)));
}

TEST(MeshSystem, SolvesAPartOfAFewRows) {
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Locked}) {
        const SystemOfMesh of(noisy(shapes::square(3), 0.05), boundary);
        ASSERT_EQ(of.surface.stars.count(), MeshSystem::kFewRows);
        const Field b = random_at_vertices(of.surface, 1);
        std::vector<Eigen::Vector3d> x(of.surface.positions.size());
        of.system.solve(of.system.blocks()[0], b, x);
        EXPECT_LT(norm(residual_of(of.system, b, x)), kSingleRounding * norm(b));
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_EQ(x[i].isZero(0), of.surface.held[i] != 0);
    }
}

/// Returns E such that (E + U)ᵀ E⁻¹ (E + U) has the diagonal of a block, but no less than `least`.
Eigen::VectorXd pivots_of(const Eigen::MatrixXd& block, const Eigen::VectorXd& least) {
    Eigen::VectorXd pivots = block.diagonal();
    for (Eigen::Index row = 0; row < block.rows(); ++row) {
        for (Eigen::Index i = 0; i < row; ++i) {
            pivots[row] -= block(i, row) * block(i, row) / pivots[i];
        }
        pivots[row] = std::max(pivots[row], least[row]);
    }
    return pivots;
}

/// Expects that each block of rows is solved by (E + U)ᵀ E⁻¹ (E + U), which is symmetric and
/// positive. Returns the number of pivots that are limited.
int expect_factorised_blocks(const SystemOfMesh& of) {
    const Eigen::MatrixXd a = of.dense();
    const Field r = random_at_vertices(of.surface, 1);
    // Rows of another block must not matter.
    Field z = Field::Constant(4, of.surface.stars.count(), std::numeric_limits<float>::quiet_NaN());
    int limited = 0;
    for (std::int32_t number = of.system.blocks().count(); number-- > 0;) {
        const PartBlocks::Block& rows_of_block = of.system.blocks()[number];
        const std::int32_t begin = rows_of_block.begin, end = rows_of_block.end;
        const double product = of.system.relax(rows_of_block, r, z);
        Eigen::MatrixXd block = a.block(begin, begin, end - begin, end - begin);
        Eigen::MatrixXd upper = block.triangularView<Eigen::StrictlyUpper>();
        Eigen::VectorXd least = upper.cwiseAbs().rowwise().sum();
        for (std::int32_t row = begin; row < end; ++row) {
            least[row - begin] += double{of.system.mass(row)};
            if (of.surface.held[row] == 0) continue;
            block.row(row - begin).setZero();
            block.col(row - begin).setZero();
            block(row - begin, row - begin) = 1;
        }
        const Eigen::VectorXd pivots = pivots_of(block, least);
        upper = block.triangularView<Eigen::StrictlyUpper>();
        upper += pivots.asDiagonal();
        const Eigen::MatrixXd product_of_factors =
            upper.transpose() * (pivots.cwiseInverse().asDiagonal() * upper);
        const Eigen::ArrayXd added = (product_of_factors - block).diagonal();
        EXPECT_GT(added.minCoeff(), -kSingleRounding * block.diagonal().maxCoeff());
        limited += static_cast<int>((added > 1e-3 * block.diagonal().array()).count());
        const Eigen::MatrixXd rows = rows_of(z).middleRows(begin, end - begin);
        const Eigen::MatrixXd right_side = rows_of(r).middleRows(begin, end - begin);
        expect_close(product_of_factors * rows, right_side);
        EXPECT_NEAR(product, rows.cwiseProduct(right_side).sum(), kSingleRounding * product);
        EXPECT_GT(product, 0);
    }
    return limited;
}

TEST(MeshSystem, RelaxesByAnIncompleteFactorisationOfEachBlock) {
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Locked}) {
        const SystemOfMesh of(noisy(bumpy_cap(20), 0.005), boundary);
        ASSERT_GT(of.surface.stars.count(), 1200);
        expect_factorised_blocks(of);
    }
}

TEST(MeshSystem, PivotsDominateTheirRowsWhereTrianglesAreObtuse) {
    const SystemOfMesh of(shapes::transformed(noisy(bumpy_cap(20), 0.02),
                                              Eigen::Affine3d(Eigen::Scaling(1.0, 0.2, 1.0))));
    EXPECT_GT(expect_factorised_blocks(of), 10);
}

TEST(MeshSystem, KeepsTheStiffnessOfTheCallBefore) {
    SystemOfMesh of(closed_mesh());
    const Surface other = squeezed(of.surface);
    const TriangleElements elements = elements_of(other);
    Field before, after;
    of.system.multiply_stiffness(of.surface.positions, 1, before);
    of.system.take(elements, kStepOfSystem, false);
    of.system.multiply_stiffness(of.surface.positions, 1, after);
    EXPECT_EQ(after, before);

    of.system.take(elements, 2 * kStepOfSystem, false);
    of.system.multiply_stiffness(of.surface.positions, 1, after);
    EXPECT_EQ(after, 2 * before);
    const Field x = random_at_vertices(of.surface, 1);
    expect_close(rows_of(of.product(x)),
                 (dense_mass(other.stars, elements) +
                  2 * kStepOfSystem * dense_stiffness(of.surface.stars, of.elements)) *
                     rows_of(x));

    of.system.take(elements, kStepOfSystem);
    expect_close(rows_of(of.product(x)), (dense_mass(other.stars, elements) +
                                          kStepOfSystem * dense_stiffness(other.stars, elements)) *
                                             rows_of(x));
}

TEST(MeshSystem, MassesKeepASmallPartOfTheFirstOnesIfTheSurfaceVanishes) {
    SystemOfMesh of(closed_mesh());
    std::vector<float> first(of.surface.positions.size());
    for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) first[i] = of.system.mass(i);
    Surface vanished = of.surface;
    for (Eigen::Vector3d& position : vanished.positions) position = {1, 2, 3};
    for (const bool takes_stiffness : {true, false}) {
        of.system.take(elements_of(vanished), kStepOfSystem, takes_stiffness);
        const Field product = of.product(Field::Constant(4, of.surface.stars.count(), 1));
        for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
            EXPECT_GE(of.system.mass(i), 1e-6F * first[i]);
            EXPECT_LE(of.system.mass(i), 1e-4F * first[i]);
            // A 1 is still the mass, to the rounding of the diagonal.
            EXPECT_NEAR(product(0, i), of.system.mass(i), 1e-5F);
        }
    }
    // Nothing moves: the right-hand side is 0.
    Field force;
    of.system.multiply_stiffness(vanished.positions, 1, force);
    EXPECT_TRUE(force.isZero(0));
    // Masses come back with the surface.
    of.system.take(of.elements, kStepOfSystem);
    for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
        EXPECT_EQ(of.system.mass(i), first[i]);
    }
}

}  // namespace
}  // namespace tracked_mcf
