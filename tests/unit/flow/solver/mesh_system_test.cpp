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
    Field product(const Field& x) const { return product_of(system, x); }

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

/// Computes z = B r. Returns r · z.
double precondition(const MeshSystem& system, const Field& r, Field& z) {
    const std::vector<Elimination::Rows> rows = rows_in_order(system);
    double product = 0;
    for (const Elimination::Rows& some : rows) product += system.solve_lower(some, r, z);
    for (auto some = rows.rbegin(); some != rows.rend(); ++some) system.solve_upper(*some, z);
    return product;
}

/// Returns a surface of the same triangles, squeezed.
Surface squeezed(Surface surface) {
    for (Eigen::Vector3d& position : surface.positions) {
        position = position.cwiseProduct(Eigen::Vector3d(1, 0.7, 0.4));
    }
    return surface;
}

TEST(MeshSystem, AdvancesLikeADenseMatrix) {
    const SystemOfMesh of(closed_mesh());
    const Eigen::MatrixXd a = of.dense();
    // What is there before the first direction must not matter.
    Field x = Field::Constant(4, of.surface.stars.count(), std::numeric_limits<float>::quiet_NaN());
    Field p = x, q = x, sum = of.zero(), direction = of.zero();
    for (const MeshSystem::Search& search :
         {MeshSystem::Search{}, MeshSystem::Search{false, 0.3F, 0.5F},
          MeshSystem::Search{false, -2, 0.1F}}) {
        const Field z = random_at_vertices(of.surface, 1);
        double energy = 0;
        for (const Elimination::Rows& rows : rows_in_order(of.system))
            energy += of.system.advance(rows, search, z, x, p, q);
        if (!search.is_first) sum += search.step * direction;
        direction = z + search.beta * direction;
        EXPECT_EQ(x, sum);
        EXPECT_EQ(p, direction);
        expect_close(rows_of(q), a * rows_of(p));
        EXPECT_NEAR(energy, rows_of(p).cwiseProduct(a * rows_of(p)).sum(),
                    kSingleRounding * energy);
    }
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
    const Field scaled = 1024 * b;
    EXPECT_EQ(residual_of(of.system, scaled, x, 1024), residual_of(of.system, b, x));
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
    precondition(of.system, everywhere, z);
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
        of.system.solve(of.system.blocks()[0], b, 1, x);
        EXPECT_LT(norm(residual_of(of.system, b, x)), kSingleRounding * norm(b));
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_EQ(x[i].isZero(0), of.surface.held[i] != 0);
    }
}

/// Returns (E + U)ᵀ E⁻¹ (E + U) x for the incomplete factorisation of a matrix, without entries
/// where `pattern` is 0, given the order in which its rows are eliminated.
Eigen::MatrixXd multiply_factors(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& pattern,
                                 const std::vector<std::int32_t>& order, const Eigen::MatrixXd& x) {
    Eigen::MatrixXd rest = matrix, product = Eigen::MatrixXd::Zero(x.rows(), x.cols());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::int32_t row = order[k];
        const double pivot = rest(row, row);
        std::vector<std::int32_t> later;
        for (std::size_t i = k + 1; i < order.size(); ++i) {
            if (pattern(order[i], row) != 0) later.push_back(order[i]);
        }
        Eigen::RowVectorXd sum = pivot * x.row(row);
        for (const std::int32_t i : later) sum += rest(i, row) * x.row(i);
        product.row(row) += sum;
        for (const std::int32_t i : later) {
            product.row(i) += rest(i, row) / pivot * sum;
            for (const std::int32_t j : later) {
                if (pattern(i, j) != 0) rest(i, j) -= rest(i, row) * rest(j, row) / pivot;
            }
        }
    }
    return product;
}

/// Returns the matrix with its positive entries moved to the diagonal.
Eigen::MatrixXd with_positive_entries_on_diagonal(Eigen::MatrixXd matrix) {
    Eigen::MatrixXd positive = matrix.cwiseMax(0);
    positive.diagonal().setZero();
    matrix -= positive;
    matrix += Eigen::MatrixXd(positive.rowwise().sum().asDiagonal());
    return matrix;
}

/// Expects that B is the inverse of the incomplete factorisation of the M-matrix, in the order of
/// elimination. Returns the number of positive entries.
std::int64_t expect_factorised(const SystemOfMesh& of, double tolerance = kSingleRounding) {
    Eigen::MatrixXd pattern = of.dense();
    const std::int64_t positive = (pattern.array() > 0).count() - pattern.rows();
    Eigen::MatrixXd a = with_positive_entries_on_diagonal(pattern);
    std::vector<std::int32_t> order;
    for (const Elimination::Rows& rows : rows_in_order(of.system))
        order.insert(order.end(), rows.begin(), rows.end());
    for (std::int32_t row = 0; row < of.surface.stars.count(); ++row) {
        if (of.surface.held[row] == 0) continue;
        a.row(row).setZero();
        a.col(row).setZero();
        a(row, row) = 1;
    }
    const Field r = random_at_vertices(of.surface, 1);
    Field z = of.zero();
    const double product = precondition(of.system, r, z);
    expect_close(multiply_factors(a, pattern, order, rows_of(z)), rows_of(r), tolerance);
    EXPECT_NEAR(product, rows_of(z).cwiseProduct(rows_of(r)).sum(), tolerance * product);
    EXPECT_GT(product, 0);
    return positive;
}

TEST(MeshSystem, PreconditionsByAnIncompleteFactorisationOfAllBlocks) {
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Locked}) {
        const SystemOfMesh of(noisy(bumpy_cap(20), 0.005), boundary);
        ASSERT_GT(of.system.blocks().count(), 1);
        ASSERT_EQ(of.system.elimination().later_stages().size(), 1);
        EXPECT_EQ(expect_factorised(of), 0);
    }
}

/// Two tips above and below a ring of so many vertices.
TriangleMesh bipyramid(int sides) {
    TriangleMesh mesh;
    mesh.positions = {{0.1, 0.2, -0.3}, {-0.1, 0.1, 0.4}};
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / sides;
        mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        const int here = 2 + i, next = 2 + (i + 1) % sides;
        mesh.triangles.push_back({0, next, here});
        mesh.triangles.push_back({1, here, next});
    }
    return mesh;
}

TEST(MeshSystem, PreconditionsWhereVerticesHaveManyNeighbours) {
    // Pivots of tips are small differences of large sums.
    expect_factorised(SystemOfMesh(bipyramid(60)), 10 * kSingleRounding);
    // Of more than one block: tips are separators.
    const SystemOfMesh large(bipyramid(1200));
    ASSERT_EQ(large.system.elimination().later_stages().size(), 1);
    expect_factorised(large, 100 * kSingleRounding);
}

TEST(MeshSystem, PreconditionsByAnMMatrixWhereTrianglesAreObtuse) {
    const SystemOfMesh of(shapes::transformed(noisy(bumpy_cap(20), 0.02),
                                              Eigen::Affine3d(Eigen::Scaling(1.0, 0.2, 1.0))));
    EXPECT_GT(expect_factorised(of), 100);
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
