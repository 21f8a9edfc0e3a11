#pragma once

#include "filter_tracked_mcf/core/element_multigrid.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Iterations after which a solve gives up.
inline constexpr int kMaximumSolverIterations = 100;

/// How a solve ended. Its measure is √(r·z), r the residual and z one V-cycle applied to it: as the
/// V-cycle is nearly the inverse of A, this is nearly the error's energy norm. The plain 2-norm of
/// r says little, being dominated by functions that are nearly dependent on the surface.
struct Convergence {
    int iterations = 0;  ///< V-cycles applied within conjugate gradients
    /// √(r·z), over the three coordinates, relative to that of x = 0; not finite if the numbers are
    /// not.
    double relative_residual = 0;
    bool reached_tolerance = true;
    double residual = 0;  ///< 2-norm of r at the end, over the three coordinates
};

/// Conjugate gradients preconditioned by a symmetric V-cycle, for three right sides at once, the
/// coordinates. They share their step lengths, which makes the three one system: its solution turns
/// as the right side does, and in a direction in which nothing pulls, nothing moves.
///
/// Vectors are single precision. A tolerance that single precision does not reach in one go is
/// reached by iterative refinement: the solution is summed and its residual computed in double.
class ConjugateGradients {
public:
    /// Solves A x = right_side on the finest level of `multigrid`, as last refreshed, until √(r·z)
    /// has fallen to `tolerance` of what it is for x = 0. Stops without that after
    /// `maximum_iterations`, or when refinement gets no further.
    ///
    /// x, a row per unknown, is a guess when this is called, such as the last step's solution, of
    /// which the best multiple is taken; if empty, zero.
    Convergence solve(ElementMultigrid& multigrid, const Field& right_side, double tolerance,
                      int maximum_iterations, Coefficients& x);

private:
    /// Makes the best multiple of the guess x_, and r_. Returns the square of the energy norm of
    /// what it has got right.
    double begin(ElementMultigrid& multigrid, const Field& right_side, const Coefficients& guess);
    /// Conjugate gradients from x_ with residual r_ and z_ = V-cycle(r_), until √(r·z), which is
    /// returned, is at most `target`.
    double descend(ElementMultigrid& multigrid, double target, int maximum_iterations,
                   int& iterations);
    /// Makes z_ and rz_ from r_; returns norm().
    double precondition(ElementMultigrid& multigrid);
    double norm() const;  ///< √(r·z)
    void tell_progress() const;

    Field x_, r_, z_, p_, q_;
    double rz_ = 0;                ///< r·z over the coordinates
    double start_ = 0, goal_ = 0;  ///< of √(r·z) in this solve
};

}  // namespace tracked_mcf
