// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

constexpr double kWeight = 0.01;

ElementSystem stabilized(const TriangleMesh& mesh, int depth, float step, bool lock = false) {
    return ElementSystem(mesh, depth, step, {lock, kWeight});
}

struct Solution {
    Coefficients x;
    Convergence convergence;
};

Solution solved(ElementSystem& system, double tolerance,
                int maximum_iterations = kMaximumSolverIterations,
                const Coefficients& guess = Coefficients()) {
    Solution solution;
    solution.x = guess;
    Field earlier_guess;
    solution.convergence =
        ConjugateGradients().solve(system.multigrid, system.right_side, tolerance,
                                   maximum_iterations, solution.x, earlier_guess);
    return solution;
}

/// Returns the energy norm of the error, relative to that of the solution.
double relative_error(const ElementSystem& system, const Coefficients& x) {
    const Dense a = assembled(system);
    const Dense b = system.right_side.cast<double>().topRows<3>().transpose();
    const Dense exact = a.partialPivLu().solve(b);
    const Dense error = x - exact;
    return std::sqrt(error.cwiseProduct(a * error).sum() / exact.cwiseProduct(a * exact).sum());
}

TEST(ConjugateGradients, VCycleIsSymmetricAndPositive) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(20), 5, 0.5F);
    const Field a = random_right_side(system), b = random_right_side(system);
    Field of_a = system.zero(), of_b = system.zero();
    system.multigrid.cycle(a, of_a);
    system.multigrid.cycle(b, of_b);
    EXPECT_LT((dot(b, of_a) - dot(a, of_b)).norm(), 1e-4 * dot(b, of_a).norm());
    EXPECT_GT(dot(a, of_a).head<3>().minCoeff(), 0);
}

TEST(ConjugateGradients, ReachesTheToleranceWithATrueErrorEstimate) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(10), 3, 2.0F);
    for (const double tolerance : {1e-2, 1e-3, 1e-5, 1e-8, 1e-10}) {
        const Solution solution = solved(system, tolerance);
        EXPECT_TRUE(solution.convergence.reached_tolerance) << tolerance;
        EXPECT_LE(solution.convergence.error_estimate, tolerance);
        EXPECT_LT(relative_error(system, solution.x), 2 * tolerance);
    }
}

TEST(ConjugateGradients, IterationsAreBoundedAtEveryDepthAndStepSize) {
    for (const int depth : {4, 5, 6}) {
        for (const float step : {1e-2F, 1.0F, 100.0F}) {
            ElementSystem system = stabilized(shapes::bumpy_sphere(40), depth, step);
            EXPECT_LE(solved(system, 1e-5).convergence.iterations, 10) << depth << " " << step;
            // Steepest descent would need up to 36.
            EXPECT_LE(solved(system, 1e-10).convergence.iterations, 24) << depth << " " << step;
        }
    }
}

TEST(ConjugateGradients, ReportsThatTheToleranceWasNotReached) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(20), 5, 0.5F);
    const Solution cut_off = solved(system, 1e-8, 2);
    EXPECT_EQ(cut_off.convergence.iterations, 2);
    EXPECT_FALSE(cut_off.convergence.reached_tolerance);
    EXPECT_GT(cut_off.convergence.error_estimate, 1e-8);

    // The paper's system with a small step size: the iteration stalls on nearly dependent
    // functions.
    ElementSystem bare(shapes::bumpy_sphere(40), 6, 1e-4F);
    const Solution stalled = solved(bare, 1e-10);
    EXPECT_LE(stalled.convergence.iterations, kMaximumSolverIterations);
    EXPECT_FALSE(stalled.convergence.reached_tolerance);
    EXPECT_TRUE(stalled.x.allFinite());
}

TEST(ConjugateGradients, ABetterGuessSavesIterations) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(40), 5, 1.0F);
    const Solution cold = solved(system, 1e-4);
    const Coefficients exact = solved(system, 1e-10).x;
    Coefficients near = exact;
    near.topRows(near.rows() / 2) *= 0.99;

    const Solution warm = solved(system, 1e-4, kMaximumSolverIterations, near);
    EXPECT_TRUE(warm.convergence.reached_tolerance);
    EXPECT_LT(warm.convergence.iterations, cold.convergence.iterations);
    // The tolerance is relative to the error of x = 0, whatever the guess.
    EXPECT_LT((warm.x - exact).norm(), 1e-3 * exact.norm());

    // The iteration starts from the best multiple of the guess.
    const Solution known = solved(system, 1e-4, kMaximumSolverIterations, -3 * exact);
    EXPECT_EQ(known.convergence.iterations, 1);
    EXPECT_TRUE(known.convergence.reached_tolerance);
    EXPECT_LT((known.x - exact).norm(), 1e-4 * exact.norm());
}

TEST(ConjugateGradients, StartsFromTheBestCombinationOfTwoGuesses) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(40), 5, 1.0F);
    const Coefficients exact = solved(system, 1e-10).x;
    Coefficients part = exact;
    part.topRows(part.rows() / 2) *= 0.1;
    ConjugateGradients conjugate_gradients;
    Field earlier_guess;
    Coefficients x = part;
    EXPECT_GT(
        conjugate_gradients.solve(system.multigrid, system.right_side, 1e-4, 20, x, earlier_guess)
            .iterations,
        1);
    // The solution is a combination of the two guesses.
    x = 2 * part - 3 * exact;
    const Convergence combined =
        conjugate_gradients.solve(system.multigrid, system.right_side, 1e-4, 20, x, earlier_guess);
    EXPECT_EQ(combined.iterations, 1);
    EXPECT_TRUE(combined.reached_tolerance);
    EXPECT_LT((x - exact).norm(), 1e-4 * exact.norm());
}

TEST(ConjugateGradients, AcceptsDependentGuesses) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(20), 4, 1.0F);
    const Coefficients exact = solved(system, 1e-10).x;
    const Coefficients zero = Coefficients::Zero(exact.rows(), 3);
    const Coefficients random = Coefficients::Random(exact.rows(), 3);
    ConjugateGradients conjugate_gradients;
    Field earlier_guess;
    for (const Coefficients& guess :
         {exact, exact, zero, random, Coefficients(1e-30 * random), Coefficients(1e20 * random)}) {
        Coefficients x = guess;
        const Convergence convergence = conjugate_gradients.solve(
            system.multigrid, system.right_side, 1e-6, 30, x, earlier_guess);
        EXPECT_TRUE(convergence.reached_tolerance);
        EXPECT_LT(relative_error(system, x), 2e-6);
    }
}

TEST(ConjugateGradients, IgnoresTheGuessForUnknownsConstrainedSince) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(20), 4, 1.0F);
    ConjugateGradients conjugate_gradients;
    Field earlier_guess;
    Coefficients x;
    for (int i = 0; i < 2; ++i) {
        conjugate_gradients.solve(system.multigrid, system.right_side, 1e-6, 30, x, earlier_guess);
    }
    std::vector<std::uint8_t> constrained = system.constrained.back();
    for (std::size_t i = 0; i < constrained.size(); i += 3) constrained[i] = 1;
    system.multigrid.constrain(constrained);
    system.multigrid.refresh(system.systems.matrices, 1);
    system.multigrid.assemble(system.systems.right_sides, system.right_side);
    const Convergence convergence =
        conjugate_gradients.solve(system.multigrid, system.right_side, 1e-6, 30, x, earlier_guess);
    EXPECT_TRUE(convergence.reached_tolerance);
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        EXPECT_EQ(x.row(static_cast<Eigen::Index>(i)).isZero(0), constrained[i] != 0);
    }
    EXPECT_LT((x - solved(system, 1e-10).x).norm(), 1e-4 * x.norm());
}

TEST(ConjugateGradients, EstimatesTheErrorAfterOneIterationCarefully) {
    // The first solve converges fast. The following ones have little more than one iteration to
    // estimate the error from, and the estimate must still hold.
    ElementSystem easy = stabilized(shapes::bumpy_sphere(10), 3, 2.0F);
    ConjugateGradients conjugate_gradients;
    Field earlier_guess;
    Coefficients x;
    conjugate_gradients.solve(easy.multigrid, easy.right_side, 1e-5, 30, x, earlier_guess);
    const Coefficients exact = solved(easy, 1e-10).x;
    for (const double distance : {1e-1, 1e-2, 1e-3}) {
        Coefficients near =
            exact + distance * exact.norm() / 30 * Coefficients::Random(exact.rows(), 3);
        const Convergence convergence = conjugate_gradients.solve(easy.multigrid, easy.right_side,
                                                                  1e-3, 30, near, earlier_guess);
        EXPECT_TRUE(convergence.reached_tolerance);
        EXPECT_LT(relative_error(easy, near), 2e-3) << distance;
    }
}

TEST(ConjugateGradients, ConvergesFromAWrongGuess) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(20), 4, 1.0F);
    const Coefficients exact = solved(system, 1e-10).x;
    const Eigen::Index rows = exact.rows();
    for (const Coefficients& guess :
         {Coefficients(Coefficients::Zero(rows, 3)), Coefficients(Coefficients::Random(rows, 3)),
          Coefficients(1e20 * Coefficients::Random(rows, 3)),
          Coefficients(1e-30 * Coefficients::Random(rows, 3))}) {
        const Solution solution = solved(system, 1e-6, kMaximumSolverIterations, guess);
        EXPECT_TRUE(solution.convergence.reached_tolerance);
        EXPECT_LT(relative_error(system, solution.x), 2e-6);
    }
}

TEST(ConjugateGradients, SolvesForAZeroRightHandSide) {
    ElementSystem system = stabilized(shapes::bumpy_sphere(10), 3, 2.0F);
    system.right_side.row(1).setZero();
    const Solution one_zero = solved(system, 1e-8);
    EXPECT_TRUE(one_zero.convergence.reached_tolerance);
    EXPECT_TRUE(one_zero.x.col(1).isZero(0));
    EXPECT_LT(relative_error(system, one_zero.x), 2e-8);

    system.right_side.setZero();
    const Solution all_zero = solved(system, 1e-8);
    EXPECT_TRUE(all_zero.convergence.reached_tolerance);
    EXPECT_EQ(all_zero.convergence.iterations, 0);
    EXPECT_TRUE(all_zero.x.isZero(0));
}

TEST(ConjugateGradients, ClaimsNoConvergenceWhereTheVCycleIsIndefinite) {
    for (const float factor : {10.0F, 100.0F}) {
        ElementSystem system = stabilized(shapes::bumpy_sphere(20), 4, 100.0F);
        // The smoother keeps the inverses of the smaller matrices, so it overshoots by this factor.
        MatrixBlocks& matrices = system.systems.matrices;
        for (std::int64_t element = 0; element < matrices.size(); ++element) {
            for (int row = 0; row < 8; ++row) {
                for (int column = row; column < 8; ++column) {
                    matrices.at(element, row, column) *= factor;
                }
            }
        }
        const Solution solution = solved(system, 0.1, 20);
        EXPECT_GT(2 * solution.convergence.error_estimate, relative_error(system, solution.x));
        EXPECT_FALSE(solution.convergence.reached_tolerance);
    }
}

TEST(ConjugateGradients, ReportsNonFiniteNumbers) {
    using Limits = std::numeric_limits<float>;
    for (const float bad : {Limits::quiet_NaN(), Limits::infinity(), Limits::max()}) {
        ElementSystem system = stabilized(shapes::bumpy_sphere(10), 3, 2.0F);
        system.right_side(0, 5) = bad;
        const Solution solution = solved(system, 1e-3);
        EXPECT_FALSE(solution.convergence.reached_tolerance) << bad;
        EXPECT_FALSE(std::isfinite(solution.convergence.error_estimate)) << bad;
    }
}

TEST(ConjugateGradients, KeepsConstrainedUnknownsAtZero) {
    TriangleMesh cap = shapes::bumpy_sphere(20);
    cap.triangles.resize(cap.triangles.size() / 2);
    ElementSystem system = stabilized(cap, 5, 0.5F, true);
    const Solution solution = solved(system, 1e-6);
    EXPECT_TRUE(solution.convergence.reached_tolerance);
    for (std::int32_t i = 0; i < system.right_side.cols(); ++i) {
        EXPECT_EQ(solution.x.row(i).isZero(0), system.constrained.back()[i] != 0);
    }
}

}  // namespace
}  // namespace tracked_mcf
