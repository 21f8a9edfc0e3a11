// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

Dense prolongation(const FirstStep& step, int level) {
    return prolongation(step.elements.levels[level], step.elements.levels[level - 1]);
}

TEST(Multigrid, CoarseMatricesAreTheGalerkinProducts) {
    const System system(shapes::bumpy_sphere(8), 4, 0.5F);
    for (int level = 4; level > 0; --level) {
        const Dense fine = dense(system.multigrid.matrix(level).matrix());
        const Dense p = prolongation(system, level);
        const Dense coarse = dense(system.multigrid.matrix(level - 1).matrix());
        EXPECT_LT((coarse - p.transpose() * fine * p).norm(), 1e-6 * coarse.norm()) << level;
    }
}

TEST(Multigrid, CoarseMatricesLeaveOutConstrainedUnknowns) {
    // Every third unknown, wherever it is.
    FirstStep step(shapes::bumpy_sphere(8), 4, 0.5);
    std::vector<std::uint8_t>& constrained = step.constrained.back();
    for (std::size_t i = 0; i < constrained.size(); i += 3) constrained[i] = 1;
    Multigrid multigrid(step.elements, step.constrained);
    multigrid.refresh(step.systems.matrices);
    Dense fine = dense(multigrid.matrix(4).matrix());
    for (std::size_t i = 0; i < constrained.size(); i += 3) {
        const auto index = static_cast<Eigen::Index>(i);
        fine.row(index).setZero();
        fine.col(index).setZero();
    }
    const Dense p = prolongation(step, 4);
    const Dense coarse = dense(multigrid.matrix(3).matrix());
    EXPECT_LT((coarse - p.transpose() * fine * p).norm(), 1e-6 * coarse.norm());
}

TEST(Multigrid, ACycleReducesTheResidualIndependentlyOfDepth) {
    for (const int depth : {4, 5, 6}) {
        const TriangleMesh mesh = shapes::geodesic_sphere(64);
        // The step size is the same at every depth in units of the mesh: δ' = δ / h².
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

TEST(Multigrid, KeepsConstrainedUnknownsAtExactlyZero) {
    TriangleMesh cap = shapes::bumpy_sphere(20);
    cap.triangles.resize(cap.triangles.size() / 2);
    System system(cap, 5, 0.5F, true);
    Field x = system.zero();
    for (int i = 0; i < 3; ++i) system.multigrid.cycle(system.right_side, x);
    int constrained = 0;
    int moved = 0;
    for (std::int32_t i = 0; i < x.cols(); ++i) {
        if (system.constrained.back()[i] != 0) {
            ++constrained;
            EXPECT_TRUE(x.col(i).isZero(0));
        } else if (!x.col(i).isZero(0)) {
            ++moved;
        }
    }
    EXPECT_GT(constrained, 50);
    EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace tracked_mcf
