#pragma once

#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/multigrid.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// The V-cycle that preconditions conjugate gradients; what their multigrid is made with.
inline constexpr CycleParameters kPreconditioner = {Smoothing::Elements, 1, 1, 1};

/// Iterations after which a solve gives up.
inline constexpr int kMaximumSolverIterations = 100;

/// How a solve ended. Its measure is √(r·z), r the residual and z one V-cycle applied to it: as the
/// V-cycle is nearly the inverse of A, this is nearly the error's energy norm. The plain 2-norm of
/// r says little, being dominated by functions that are nearly dependent on the surface.
struct Convergence {
    int iterations = 0;  ///< V-cycles applied within conjugate gradients
    /// √(r·z), over the three coordinates, relative to the start; not finite if the numbers are
    /// not.
    double relative_residual = 0;
    bool reached_tolerance = true;
};

/// Conjugate gradients preconditioned by a symmetric V-cycle, for three right sides at once, the
/// coordinates. They share their step lengths, which makes the three one system: its solution turns
/// as the right side does, and in a direction in which nothing pulls, nothing moves.
///
/// Vectors are single precision. A tolerance that single precision does not reach in one go is
/// reached by iterative refinement: the solution is summed and its residual computed in double.
class ConjugateGradients {
public:
    /// Solves A x = right_side on the finest level of `multigrid` from x = 0 until √(r·z) has
    /// fallen to `tolerance` of its start. Stops without that after `maximum_iterations`, or when
    /// refinement gets no further. x: a row per unknown.
    Convergence solve(Multigrid& multigrid, const Field& right_side, double tolerance,
                      int maximum_iterations, Coefficients& x);

private:
    /// Conjugate gradients from x_ = 0 for the right side in r_, with z_ = V-cycle(r_), until
    /// √(r·z), which is returned, is at most `target`.
    double descend(Multigrid& multigrid, double target, int maximum_iterations, int& iterations);
    /// Makes z_ and rz_ from r_; returns norm().
    double precondition(Multigrid& multigrid);
    double norm() const;  ///< √(r·z)
    void tell_progress() const;

    Field x_, r_, z_, p_, q_;
    Eigen::Vector4d rz_;           ///< r·z of every coordinate
    double start_ = 0, goal_ = 0;  ///< of √(r·z) in this solve
};

}  // namespace tracked_mcf
