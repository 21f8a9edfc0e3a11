#include "filter_tracked_mcf/core/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/galerkin.h"
#include "tests/support/shapes.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

TEST(LevelMatrix, IsTheSumOfItsElementMatrices) {
    const System system(shapes::bumpy_sphere(6), 3, 0.5F);
    const Dense expected = assembled(system);
    const Dense matrix = dense(system.multigrid.finest().matrix());
    EXPECT_LT((matrix - expected).norm(), 1e-6 * expected.norm());
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-6 * matrix.norm());
}

TEST(Hierarchy, CoarseMatricesAreTheGalerkinProducts) {
    const System system(shapes::bumpy_sphere(8), 4, 0.5F);
    for (int level = 4; level > 0; --level) {
        const Dense fine = dense(system.multigrid.matrix(level).matrix());
        const Dense p = dense(system.multigrid.prolongation(level));
        const Dense coarse = dense(system.multigrid.matrix(level - 1).matrix());
        EXPECT_LT((coarse - p.transpose() * fine * p).norm(), 1e-6 * coarse.norm()) << level;
    }
}

TEST(Hierarchy, CoarseMatricesLeaveOutFrozenUnknowns) {
    // Any unknowns, not only such as a boundary locks.
    System system(shapes::bumpy_sphere(8), 4, 0.5F);
    std::vector<std::uint8_t>& frozen = system.multigrid.frozen();
    for (std::size_t i = 0; i < frozen.size(); i += 3) frozen[i] = 1;
    system.multigrid.refresh(system.systems.matrices);
    Dense fine = dense(system.multigrid.matrix(4).matrix());
    for (std::size_t i = 0; i < frozen.size(); i += 3) {
        const auto index = static_cast<Eigen::Index>(i);
        fine.row(index).setZero();
        fine.col(index).setZero();
    }
    const Dense p = dense(system.multigrid.prolongation(4));
    const Dense coarse = dense(system.multigrid.matrix(3).matrix());
    EXPECT_LT((coarse - p.transpose() * fine * p).norm(), 1e-6 * coarse.norm());
}

TEST(Hierarchy, ParentsElementMatrixIsTheSumOverItsChildren) {
    const System system(shapes::bumpy_sphere(8), 4, 0.5F);
    const Level& fine = system.elements.levels[4];
    const std::int32_t parents = system.elements.levels[3].element_count();
    MatrixBlocks coarse(parents);
    coarsen_element_matrices(fine, Groups(fine.parents, parents), system.systems.matrices, coarse);

    using Matrix8 = Eigen::Matrix<float, 8, 8, Eigen::RowMajor>;
    std::vector<Matrix8> expected(static_cast<std::size_t>(parents), Matrix8::Zero());
    for (std::int32_t child = 0; child < fine.element_count(); ++child) {
        const Matrix8 p = refinement_weights(octant_of(fine.cells[child])).cast<float>();
        const ElementMatrix of_child = system.systems.matrices.of(child);
        const Eigen::Map<const Matrix8> k(of_child.entry[0]);
        expected[fine.parents[child]] += p.transpose() * k * p;
    }
    for (std::int32_t parent = 0; parent < parents; ++parent) {
        const ElementMatrix of_parent = coarse.of(parent);
        const Eigen::Map<const Matrix8> sum(of_parent.entry[0]);
        EXPECT_LT((sum - expected[parent]).norm(), 1e-6F * expected[parent].norm());
    }
}

TEST(Hierarchy, ProlongationKeepsConstants) {
    const System system(shapes::bumpy_sphere(8), 4, 0.5F);
    for (int level = 1; level <= 4; ++level) {
        const SparseMatrix& p = system.multigrid.prolongation(level);
        const Eigen::VectorXf ones = p * Eigen::VectorXf::Ones(p.cols());
        EXPECT_EQ(ones, Eigen::VectorXf::Ones(p.rows()));
    }
}

TEST(GaussSeidel, IsAForwardSubstitution) {
    // Small enough for one slab, so one sweep is (D + L)⁻¹ (b - U x) in its order of the unknowns.
    const System system(shapes::bumpy_sphere(6), 3, 0.5F);
    const Dense unordered = dense(system.multigrid.finest().matrix());
    const GaussSeidel gauss_seidel(system.elements.finest());
    const std::vector<std::int32_t>& order = gauss_seidel.order();
    const Dense a = unordered(order, order);
    Field x = Field::Random(4, a.rows());
    x.row(3).setZero();
    const Dense b = system.right_side.cast<double>().transpose()(order, Eigen::all);
    const Dense upper = a.triangularView<Eigen::StrictlyUpper>();
    const Dense start = x.cast<double>().transpose()(order, Eigen::all);
    const Dense expected = a.triangularView<Eigen::Lower>().solve(b - upper * start);
    gauss_seidel.sweep(system.multigrid.finest(), system.right_side, x);
    // Entries of functions that barely meet the surface are large and ill determined: compare what
    // the sweep makes of the equations.
    const Dense swept = x.cast<double>().transpose()(order, Eigen::all);
    const Dense difference = a * (swept - expected);
    EXPECT_LT(difference.norm(), 1e-5 * (a * expected).norm());
}

TEST(CoarseSolver, SolvesASingularSystemInTheLeastSquaresSense) {
    // A flat patch in a grid plane: the four functions off the plane have empty rows.
    const System system(shapes::square(4), 1, 0.5F);
    MatrixBlocks coarsest(1);
    coarsen_element_matrices(system.elements.levels[1],
                             Groups(system.elements.levels[1].parents, 1), system.systems.matrices,
                             coarsest);
    CoarseSolver solver(system.elements.levels[0]);
    solver.factorise(coarsest);
    const Dense a = assembled(system.elements.levels[0], coarsest);
    const Field exact = Field::Random(4, a.rows());
    const Field b = (a * exact.cast<double>().transpose()).transpose().cast<float>();
    Field x;
    solver.solve(b, x);
    EXPECT_TRUE(x.allFinite());
    EXPECT_LT((a * x.cast<double>().transpose() - b.cast<double>().transpose()).norm(),
              1e-4 * b.norm());
}

TEST(Multigrid, ACycleReducesTheResidualIndependentlyOfDepth) {
    for (const int depth : {4, 5, 6}) {
        const TriangleMesh mesh = shapes::geodesic_sphere(64);
        // The same step on the surface at every depth: δ' = δ / h².
        System system(mesh, depth, 1e-3F * std::pow(4.0F, static_cast<float>(depth)));
        Field x = system.zero();
        const double before = system.residual(x);
        system.multigrid.cycle(system.right_side, x);
        EXPECT_LT(system.residual(x), 0.1 * before) << depth;
    }
}

TEST(Multigrid, CyclesApproachTheSolutionInTheEnergyNorm) {
    System system(shapes::bumpy_sphere(10), 3, 2.0F);
    const Dense a = dense(system.multigrid.finest().matrix());
    const Dense b = system.right_side.cast<double>().transpose();
    const Dense exact = a.completeOrthogonalDecomposition().solve(b);
    Field x = system.zero();
    double previous = exact.cwiseProduct(a * exact).sum();
    for (int i = 0; i < 3; ++i) {
        system.multigrid.cycle(system.right_side, x);
        const Dense error = x.cast<double>().transpose() - exact;
        const double energy = error.cwiseProduct(a * error).sum();
        EXPECT_LT(energy, previous);
        previous = energy;
    }
    EXPECT_LT(previous, 1e-4 * exact.cwiseProduct(a * exact).sum());
}

TEST(BoundaryLock, NoUnlockedCoarseFunctionContainsALockedFineOne) {
    const System system(shapes::square(20), 4, 0.5F, {true});
    for (int level = 1; level <= 4; ++level) {
        const SparseMatrix& p = system.multigrid.prolongation(level);
        for (std::int32_t fine = 0; fine < p.rows(); ++fine) {
            if (system.frozen[level][fine] == 0) continue;
            for (SparseMatrix::InnerIterator entry(p, fine); entry; ++entry) {
                EXPECT_EQ(system.frozen[level - 1][entry.col()], 1);
            }
        }
    }
}

TEST(BoundaryLock, LockedUnknownsStayExactlyZero) {
    TriangleMesh cap = shapes::bumpy_sphere(20);
    cap.triangles.resize(cap.triangles.size() / 2);
    System system(cap, 5, 0.5F, {true});
    Field x = system.zero();
    for (int i = 0; i < 3; ++i) system.multigrid.cycle(system.right_side, x);
    int locked = 0;
    int moved = 0;
    for (std::int32_t i = 0; i < x.cols(); ++i) {
        if (system.frozen.back()[i] != 0) {
            ++locked;
            EXPECT_TRUE(x.col(i).isZero(0));
        } else if (!x.col(i).isZero(0)) {
            ++moved;
        }
    }
    EXPECT_GT(locked, 50);
    EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace tracked_mcf
