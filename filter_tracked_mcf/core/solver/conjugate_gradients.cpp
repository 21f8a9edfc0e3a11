// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Below this fraction of its initial norm, a residual from recurrences in single precision differs
/// from the true residual.
constexpr double kSinglePrecision = 1e-5;

/// A round of refinement makes progress if it reduces the error by this factor.
constexpr double kWorthRefining = 0.5;

/// Usual ratio of the decreases of the squared error in two consecutive iterations.
constexpr double kUsualDecreaseRatio = 0.1;

/// A step length is about 1 or greater, because the V-cycle is nearly the inverse of A. If it is
/// less than this, or negative, the V-cycle has overshot along a few functions with much energy.
/// The decrease is theirs, and says nothing about the error that remains.
constexpr double kOvershot = 0.5;

/// Returns a / b if b is positive, else 0, for then nothing is left to solve.
double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

/// Returns the sum of the terms of a geometric series after the last one.
double rest_of_series(double last, double ratio) {
    return ratio < 1 ? last * ratio / (1 - ratio) : std::numeric_limits<double>::max();
}

/// Returns whether a single-precision vector can be multiplied by this number.
bool is_factor(double number) {
    return std::abs(number) <= std::numeric_limits<float>::max();
}

}  // namespace

void ConjugateGradients::begin(ElementMultigrid& multigrid, const Field& right_side,
                               const Coefficients& guess, Field& earlier_guess) {
    copy(right_side, r_);
    set_zero(x_, r_.cols());
    total_decrease_ = 0;
    if (guess.size() == 0) return;
    const auto is_free = [&](std::int32_t row) { return multigrid.free_unknowns()[row] != 0; };
    set_zero(z_, r_.cols());
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        if (is_free(row)) z_.col(row).head<3>() = guess.row(row).transpose().cast<float>();
    });
    copy(z_, p_);
    const double energy = minimize_along(multigrid);
    // Make the earlier guess A-orthogonal to this one.
    const bool has_earlier = earlier_guess.cols() == r_.cols();
    const double common = has_earlier ? ratio(dot(q_, earlier_guess).sum(), energy) : 0;
    if (has_earlier && is_factor(common)) {
        const auto factor = static_cast<float>(common);
        parallel_for_rows(r_.cols(), [&](std::int32_t row) {
            if (is_free(row)) p_.col(row) = earlier_guess.col(row) - factor * p_.col(row);
        });
        minimize_along(multigrid);
    }
    earlier_guess.swap(z_);
}

double ConjugateGradients::minimize_along(ElementMultigrid& multigrid) {
    // alpha = r·p / p·Ap minimizes the energy norm of the error: it becomes A-orthogonal to p.
    const double energy = multigrid.multiply(p_, q_);
    const double rp = dot(r_, p_).sum();
    const double alpha = ratio(rp, energy);
    if (!(energy > 0) || !is_factor(alpha)) return 0;
    move(static_cast<float>(alpha));
    total_decrease_ += alpha * rp;
    return energy;
}

void ConjugateGradients::move(float alpha) {
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        x_.col(row) += alpha * p_.col(row);
        r_.col(row) -= alpha * q_.col(row);
    });
}

double ConjugateGradients::descend(ElementMultigrid& multigrid, double goal, double factor,
                                   int maximum_iterations, int& iterations) {
    double rz = 0;
    double decrease = 0;
    double error = std::numeric_limits<double>::max();
    double start = 0;
    while (iterations < maximum_iterations) {
        multigrid.cycle(r_, z_);
        const double rz_before = std::exchange(rz, dot(r_, z_).sum());
        if (rz == 0) return 0;
        if (!std::isfinite(rz)) return rz;
        // Where parts have pinched, rounding errors may make the V-cycle, or A, indefinite. If rz
        // is negative, alpha is too, and conjugate gradients restart from this direction.
        const auto beta = static_cast<float>(rz > 0 ? ratio(rz, rz_before) : 0);
        if (start == 0) {
            // The V-cycle is nearly the inverse of A, so this is nearly the error.
            start = std::sqrt(std::abs(rz));
            if (first_error_ == 0) first_error_ = start;
            copy(z_, p_);
        } else {
            parallel_for_rows(r_.cols(), [&](std::int32_t row) {
                p_.col(row) = z_.col(row) + beta * p_.col(row);
            });
        }
        ++iterations;
        const double energy = multigrid.multiply(p_, q_);
        const double alpha = ratio(rz, energy);
        if (!std::isfinite(energy)) return energy;
        // Rounding errors may leave a direction without energy; then the solve gives up.
        if (energy <= 0 || !is_factor(alpha)) return std::numeric_limits<double>::max();
        move(static_cast<float>(alpha));
        total_decrease_ += alpha * rz;
        if (alpha < kOvershot) continue;
        const double decrease_before = std::exchange(decrease, alpha * rz);
        if (decrease > 0 && decrease_before > 0) decrease_ratio_ = decrease / decrease_before;
        // The ratio of an earlier solve says little about a first iteration, so be careful.
        const double next_ratio =
            decrease_before > 0 ? decrease_ratio_ : std::max(decrease_ratio_, kUsualDecreaseRatio);
        error = std::sqrt(rest_of_series(decrease, next_ratio));
        tell_progress(error, goal);
        if (error <= std::max(goal * error_of_zero(error), factor * start)) break;
    }
    return error;
}

double ConjugateGradients::error_of_zero(double error) const {
    return std::hypot(std::sqrt(total_decrease_), error);
}

void ConjugateGradients::tell_progress(double error, double goal) {
    // Every iteration reduces the error by about the same factor.
    const double target = goal * error_of_zero(error);
    if (error > 0 && target > 0) {
        advance_progress(std::log(first_error_ / error) / std::log(first_error_ / target));
    }
}

Convergence ConjugateGradients::solve(ElementMultigrid& multigrid, const Field& right_side,
                                      double tolerance, int maximum_iterations, Coefficients& x,
                                      Field& earlier_guess) {
    begin(multigrid, right_side, x, earlier_guess);
    first_error_ = 0;
    x.setZero(right_side.cols(), 3);
    Convergence result;
    const bool refines = tolerance < kSinglePrecision;
    double error = 0;
    for (double before = std::numeric_limits<double>::infinity();; before = error) {
        error = descend(multigrid, tolerance, refines ? kSinglePrecision : 0, maximum_iterations,
                        result.iterations);
        x += x_.topRows<3>().transpose().cast<double>();
        if (!refines || error <= tolerance * error_of_zero(error) ||
            !(error < kWorthRefining * before) || result.iterations >= maximum_iterations) {
            break;
        }
        multigrid.residual(right_side, x, r_);
        set_zero(x_, r_.cols());
    }
    result.error_estimate = error == 0 ? 0 : error / error_of_zero(error);
    result.reached_tolerance = result.error_estimate <= tolerance;
    result.residual = norm(r_);
    return result;
}

}  // namespace tracked_mcf
