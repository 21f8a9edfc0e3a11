#pragma once

#include "filter_tracked_mcf/core/element_multigrid.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Iterations after which a solve gives up.
inline constexpr int kMaximumSolverIterations = 100;

/// How a solve ended. Errors are measured in the energy norm √(e·Ae): the plain 2-norm of the
/// residual says little, being dominated by functions that are nearly dependent on the surface.
struct Convergence {
    int iterations = 0;  ///< V-cycles that were made
    /// The error that is left, over the three coordinates, relative to that of x = 0; not finite
    /// if the numbers are not. An estimate: every iteration lessens the square of the error by a
    /// known number (Hestenes and Stiefel 1952, theorem 6:1); those to come are taken for a
    /// geometric series that goes on as the last two did or, after the first iteration, as an
    /// earlier solve's, and not better than is usual.
    double relative_error = 0;
    bool reached_tolerance = true;
    double residual = 0;  ///< 2-norm of the residual at the end, over the three coordinates
};

/// Conjugate gradients preconditioned by a symmetric V-cycle, for three right sides at once, the
/// coordinates. They share their step lengths, which makes the three one system: its solution turns
/// as the right side does, and in a direction in which nothing pulls, nothing moves.
///
/// Vectors are single precision. A tolerance that single precision does not reach in one go is
/// reached by iterative refinement: the solution is summed and its residual computed in double.
class ConjugateGradients {
public:
    /// Solves A x = right_side on the finest level of `multigrid`, as last refreshed, until the
    /// error has fallen to `tolerance` of that of x = 0. Stops without that after
    /// `maximum_iterations`, or when refinement gets no further.
    ///
    /// x, a row per unknown, is a guess when this is called, such as the last step's solution; if
    /// empty, there is none. The best combination of it and of an earlier call's guess is taken:
    /// what changes smoothly from step to step is mostly that.
    Convergence solve(ElementMultigrid& multigrid, const Field& right_side, double tolerance,
                      int maximum_iterations, Coefficients& x);

private:
    /// Makes x_, the best combination of the guesses, and r_.
    void begin(ElementMultigrid& multigrid, const Field& right_side, const Coefficients& guess);
    /// Moves x_ along p_ to where the error is the least, and makes q_ = A p_; returns p·Ap.
    double go_along(ElementMultigrid& multigrid);
    /// Conjugate gradients from x_ with residual r_, until the error, which is returned, is at most
    /// `goal` of that of x = 0 or `factor` of what it was when this was called.
    double descend(ElementMultigrid& multigrid, double goal, double factor, int maximum_iterations,
                   int& iterations);
    double whole(double error) const;  ///< the error of x = 0, given that of x_
    void tell_progress(double error, double goal);

    Field x_, r_, z_, p_, q_;
    Field earlier_guess_;
    double fall_ = 0;         ///< of the square of the error, from one iteration to the next
    double solved_ = 0;       ///< square of the energy norm of what has been got right
    double first_error_ = 0;  ///< with which this solve began; 0 before
};

}  // namespace tracked_mcf
