#include "filter_tracked_mcf/core/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Below this fraction of where it began, a residual that single-precision recurrences carry along
/// is no longer the true one.
constexpr double kSinglePrecision = 1e-5;

/// Refinement that gains less than this gets no further.
constexpr double kWorthRefining = 0.5;

/// Σ a / Σ b, over the coordinates, where that is positive, else 0: nothing is left to solve.
float ratio(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
    return b.sum() > 0 ? static_cast<float>(a.sum() / b.sum()) : 0;
}

}  // namespace

double ConjugateGradients::precondition(Multigrid& multigrid) {
    set_zero(z_, r_.cols());
    multigrid.cycle(r_, z_);
    rz_ = dot(r_, z_);
    return norm();
}

double ConjugateGradients::norm() const {
    // Were the V-cycle not positive for once, for rounding, that must not pass for convergence.
    return std::sqrt(rz_.cwiseAbs().sum());
}

double ConjugateGradients::descend(Multigrid& multigrid, double target, int maximum_iterations,
                                   int& iterations) {
    set_zero(x_, r_.cols());
    p_.resize(4, r_.cols());
    parallel_for_rows(r_.cols(), [&](std::int32_t row) { p_.col(row) = z_.col(row); });
    while (norm() > target && iterations < maximum_iterations) {
        multigrid.finest().multiply(p_, q_);
        const float step = ratio(rz_, dot(p_, q_));
        parallel_for_rows(r_.cols(), [&](std::int32_t row) {
            x_.col(row) += step * p_.col(row);
            r_.col(row) -= step * q_.col(row);
        });
        const Eigen::Vector4d before = rz_;
        precondition(multigrid);
        ++iterations;
        tell_progress();
        const float turn = ratio(rz_, before);
        parallel_for_rows(
            r_.cols(), [&](std::int32_t row) { p_.col(row) = z_.col(row) + turn * p_.col(row); });
    }
    return norm();
}

void ConjugateGradients::tell_progress() const {
    // √(r·z) falls by about the same factor in every iteration.
    if (norm() > 0) advance_progress(std::log(start_ / norm()) / std::log(start_ / goal_));
}

Convergence ConjugateGradients::solve(Multigrid& multigrid, const Field& right_side,
                                      double tolerance, int maximum_iterations, Coefficients& x) {
    x.setZero(right_side.cols(), 3);
    multigrid.finest().residual(right_side, x, r_);
    const double start = precondition(multigrid);
    const double goal = tolerance * start;
    start_ = start;
    goal_ = goal;
    const bool refines = tolerance < kSinglePrecision;
    Convergence result;
    double reached = start;
    for (double before = start; reached > goal && result.iterations < maximum_iterations;) {
        reached = descend(multigrid, std::max(goal, kSinglePrecision * before), maximum_iterations,
                          result.iterations);
        x += x_.topRows<3>().transpose().cast<double>();
        if (!refines) break;
        multigrid.finest().residual(right_side, x, r_);
        reached = precondition(multigrid);
        if (!(reached < kWorthRefining * before)) break;
        before = reached;
    }
    result.relative_residual = start == 0 ? 0 : reached / start;
    result.reached_tolerance = std::isfinite(reached) && reached <= goal;
    return result;
}

}  // namespace tracked_mcf
