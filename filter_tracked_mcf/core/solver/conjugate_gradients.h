// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/solver/element_multigrid.h"
#include "filter_tracked_mcf/core/solver/field.h"

namespace tracked_mcf {

/// Greatest number of iterations of a solve.
inline constexpr int kMaximumSolverIterations = 100;

/// The outcome of a solve. Errors are measured in the energy norm √(e·Ae). The 2-norm of the
/// residual says little, because functions that are nearly dependent on the surface dominate it.
struct Convergence {
    int iterations = 0;  ///< number of V-cycles
    /// Estimate of the remaining error over the three coordinates, relative to the error of x = 0.
    /// Not finite if the numbers are not. Each iteration reduces the squared error by a known
    /// number (Hestenes and Stiefel 1952, theorem 6:1). The estimate extrapolates these decreases
    /// as a geometric series, whose ratio is that of the last two decreases. After one iteration,
    /// the ratio is that of an earlier solve, but at least the usual one. Iterations in which the
    /// V-cycle overshot do not count.
    double error_estimate = 0;
    bool reached_tolerance = true;
    double residual = 0;  ///< 2-norm of the final residual over the three coordinates
};

/// Conjugate gradients for three right-hand sides at once, the coordinates, preconditioned by a
/// symmetric V-cycle. The coordinates share their step lengths, so they form one system. Therefore
/// the solution rotates with the right-hand side, and is zero in directions in which the right-hand
/// side is zero.
///
/// Vectors are single precision. If a tolerance is too small for single precision, iterative
/// refinement reaches it: it sums the solution and computes its residual in double.
class ConjugateGradients {
public:
    /// Solves A x = right_side on the finest level of `multigrid`, as last refreshed, until the
    /// error is at most `tolerance` times the error of x = 0. Stops early after
    /// `maximum_iterations`, or if refinement makes no more progress.
    ///
    /// On entry, x is a guess with one row per unknown, such as the last step's solution, or empty.
    /// The iteration starts from the best linear combination of this guess and `earlier_guess`, the
    /// guess of the last solve for the same quantity, because a solution that changes smoothly from
    /// step to step is close to one. `earlier_guess` may be empty; it becomes this guess.
    Convergence solve(ElementMultigrid& multigrid, const Field& right_side, double tolerance,
                      int maximum_iterations, Coefficients& x, Field& earlier_guess);

private:
    /// Sets x_ to the best combination of the guesses, and r_ to its residual.
    void begin(ElementMultigrid& multigrid, const Field& right_side, const Coefficients& guess,
               Field& earlier_guess);
    /// Sets q_ = A p_ and minimizes the error along p_. Returns p·Ap, or 0 if rounding prevents
    /// this.
    double minimize_along(ElementMultigrid& multigrid);
    /// Moves x_ by alpha * p_, and updates its residual r_.
    void move(float alpha);
    /// Iterates from x_ with residual r_. Returns the error, which is at most `goal` times the
    /// error of x = 0, or `factor` times the initial error, unless the iteration stops early.
    double descend(ElementMultigrid& multigrid, double goal, double factor, int maximum_iterations,
                   int& iterations);
    /// Returns the error of x = 0, given that of x_.
    double error_of_zero(double error) const;
    void tell_progress(double error, double goal);

    Field x_, r_, z_, p_, q_;
    double total_decrease_ = 0;  ///< of the squared error, since x = 0
    double decrease_ratio_ = 0;  ///< of the last two decreases of the squared error
    double first_error_ = 0;     ///< at the start of this solve; 0 before
};

}  // namespace tracked_mcf
