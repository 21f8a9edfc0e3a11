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

/// a / b where b is positive, else 0: nothing is left to solve.
double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

}  // namespace

double ConjugateGradients::precondition(ElementMultigrid& multigrid) {
    multigrid.cycle(r_, z_);
    rz_ = dot(r_, z_).sum();
    return norm();
}

double ConjugateGradients::norm() const {
    // Were the V-cycle not positive for once, for rounding, that must not pass for convergence.
    return std::sqrt(std::abs(rz_));
}

double ConjugateGradients::begin(ElementMultigrid& multigrid, const Field& right_side,
                                 const Coefficients& guess) {
    copy(right_side, r_);
    set_zero(x_, r_.cols());
    if (guess.size() == 0) return 0;
    set_zero(p_, r_.cols());
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        if (multigrid.movable()[row] == 0) return;
        p_.col(row).head<3>() = guess.row(row).transpose().cast<float>();
    });
    // x = s p has the least error in the energy norm where b·p = s p·Ap.
    const double energy = multigrid.multiply(p_, q_);
    const double pull = dot(right_side, p_).sum();
    const double scale = ratio(pull, energy);
    const auto step = static_cast<float>(scale);
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        x_.col(row) = step * p_.col(row);
        r_.col(row) -= step * q_.col(row);
    });
    return scale * pull;
}

double ConjugateGradients::descend(ElementMultigrid& multigrid, double target,
                                   int maximum_iterations, int& iterations) {
    copy(z_, p_);
    while (norm() > target && iterations < maximum_iterations) {
        const auto step = static_cast<float>(ratio(rz_, multigrid.multiply(p_, q_)));
        parallel_for_rows(r_.cols(), [&](std::int32_t row) {
            x_.col(row) += step * p_.col(row);
            r_.col(row) -= step * q_.col(row);
        });
        const double before = rz_;
        precondition(multigrid);
        ++iterations;
        tell_progress();
        const auto turn = static_cast<float>(ratio(rz_, before));
        parallel_for_rows(
            r_.cols(), [&](std::int32_t row) { p_.col(row) = z_.col(row) + turn * p_.col(row); });
    }
    return norm();
}

void ConjugateGradients::tell_progress() const {
    // √(r·z) falls by about the same factor in every iteration.
    if (norm() > 0) advance_progress(std::log(start_ / norm()) / std::log(start_ / goal_));
}

Convergence ConjugateGradients::solve(ElementMultigrid& multigrid, const Field& right_side,
                                      double tolerance, int maximum_iterations, Coefficients& x) {
    const double guessed = begin(multigrid, right_side, x);
    double before = precondition(multigrid);
    // What the guess has got right and its error are orthogonal.
    const double all = std::sqrt(guessed + std::abs(rz_));
    start_ = before;
    goal_ = tolerance * all;
    x.setZero(right_side.cols(), 3);
    const bool refines = tolerance < kSinglePrecision;
    Convergence result;
    double reached = before;
    while (true) {
        reached = descend(multigrid, std::max(goal_, kSinglePrecision * before), maximum_iterations,
                          result.iterations);
        x += x_.topRows<3>().transpose().cast<double>();
        if (!refines) break;
        multigrid.residual(right_side, x, r_);
        set_zero(x_, r_.cols());
        reached = precondition(multigrid);
        if (reached <= goal_ || !(reached < kWorthRefining * before)) break;
        if (result.iterations >= maximum_iterations) break;
        before = reached;
    }
    result.relative_residual = all == 0 ? 0 : reached / all;
    result.reached_tolerance = std::isfinite(reached) && reached <= goal_;
    result.residual = tracked_mcf::norm(r_);
    return result;
}

}  // namespace tracked_mcf
