#include "filter_tracked_mcf/core/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Below this fraction of where it began, a residual that single-precision recurrences carry along
/// is no longer the true one.
constexpr double kSinglePrecision = 1e-5;

/// Refinement that gains less than this gets no further.
constexpr double kWorthRefining = 0.5;

/// How the square of the error falls from one iteration to the next, as long as it is not known.
constexpr double kUsualFall = 0.1;

/// a / b where b is positive, else 0: nothing is left to solve.
double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

/// What the terms to come of a geometric series add up to.
double rest_of_series(double last, double fall) {
    return fall < 1 ? last * fall / (1 - fall) : std::numeric_limits<double>::max();
}

/// Whether a vector can be multiplied by this.
bool is_factor(double number) {
    return std::abs(number) <= std::numeric_limits<float>::max();
}

}  // namespace

void ConjugateGradients::begin(ElementMultigrid& multigrid, const Field& right_side,
                               const Coefficients& guess) {
    copy(right_side, r_);
    set_zero(x_, r_.cols());
    solved_ = 0;
    if (guess.size() == 0) return;
    const auto movable = [&](std::int32_t row) { return multigrid.movable()[row] != 0; };
    set_zero(z_, r_.cols());
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        if (movable(row)) z_.col(row).head<3>() = guess.row(row).transpose().cast<float>();
    });
    copy(z_, p_);
    const double energy = go_along(multigrid);
    // What the earlier guess has in common with this one has been gone along.
    const bool has_earlier = earlier_guess_.cols() == r_.cols();
    const double common = has_earlier ? ratio(dot(q_, earlier_guess_).sum(), energy) : 0;
    if (has_earlier && is_factor(common)) {
        const auto share = static_cast<float>(common);
        parallel_for_rows(r_.cols(), [&](std::int32_t row) {
            if (movable(row)) p_.col(row) = earlier_guess_.col(row) - share * p_.col(row);
        });
        go_along(multigrid);
    }
    earlier_guess_.swap(z_);
}

double ConjugateGradients::go_along(ElementMultigrid& multigrid) {
    // The error is least where it is orthogonal to p: x changes by s p with r·p = s p·Ap.
    const double energy = multigrid.multiply(p_, q_);
    const double pull = dot(r_, p_).sum();
    const double scale = ratio(pull, energy);
    if (!(energy > 0) || !is_factor(scale)) return 0;
    const auto step = static_cast<float>(scale);
    parallel_for_rows(r_.cols(), [&](std::int32_t row) {
        x_.col(row) += step * p_.col(row);
        r_.col(row) -= step * q_.col(row);
    });
    solved_ += scale * pull;
    return energy;
}

double ConjugateGradients::descend(ElementMultigrid& multigrid, double goal, double factor,
                                   int maximum_iterations, int& iterations) {
    double rz = 0;
    double gain = 0;
    double error = std::numeric_limits<double>::max();
    double start = 0;
    while (iterations < maximum_iterations) {
        multigrid.cycle(r_, z_);
        const double rz_before = std::exchange(rz, dot(r_, z_).sum());
        if (rz == 0) return 0;
        if (!std::isfinite(rz)) return rz;
        // Where parts have pinched, rounding may leave the V-cycle, or A, not quite positive. Then
        // its direction is gone along backwards, and conjugate gradients begin anew.
        const auto turn = static_cast<float>(rz > 0 ? ratio(rz, rz_before) : 0);
        if (start == 0) {
            // As the V-cycle is nearly the inverse of A, that is nearly the error.
            start = std::sqrt(std::abs(rz));
            if (first_error_ == 0) first_error_ = start;
            copy(z_, p_);
        } else {
            parallel_for_rows(r_.cols(), [&](std::int32_t row) {
                p_.col(row) = z_.col(row) + turn * p_.col(row);
            });
        }
        ++iterations;
        const double energy = multigrid.multiply(p_, q_);
        const double scale = ratio(rz, energy);
        if (!std::isfinite(energy)) return energy;
        // Nothing can be gained along what rounding has left without energy.
        if (energy <= 0 || !is_factor(scale)) return std::numeric_limits<double>::max();
        const auto step = static_cast<float>(scale);
        parallel_for_rows(r_.cols(), [&](std::int32_t row) {
            x_.col(row) += step * p_.col(row);
            r_.col(row) -= step * q_.col(row);
        });
        const double gain_before = std::exchange(gain, scale * rz);
        solved_ += gain;
        if (gain > 0 && gain_before > 0) fall_ = gain / gain_before;
        // What an earlier solve's iterations gained says little about a first one's: be careful.
        const double fall = gain_before > 0 ? fall_ : std::max(fall_, kUsualFall);
        error = std::sqrt(rest_of_series(gain, fall));
        tell_progress(error, goal);
        if (error <= std::max(goal * whole(error), factor * start)) break;
    }
    return error;
}

double ConjugateGradients::whole(double error) const {
    return std::hypot(std::sqrt(solved_), error);
}

void ConjugateGradients::tell_progress(double error, double goal) {
    // The error falls by about the same factor in every iteration.
    const double target = goal * whole(error);
    if (error > 0 && target > 0) {
        advance_progress(std::log(first_error_ / error) / std::log(first_error_ / target));
    }
}

Convergence ConjugateGradients::solve(ElementMultigrid& multigrid, const Field& right_side,
                                      double tolerance, int maximum_iterations, Coefficients& x) {
    begin(multigrid, right_side, x);
    first_error_ = 0;
    x.setZero(right_side.cols(), 3);
    Convergence result;
    const bool refines = tolerance < kSinglePrecision;
    double error = 0;
    for (double before = std::numeric_limits<double>::infinity();; before = error) {
        error = descend(multigrid, tolerance, refines ? kSinglePrecision : 0, maximum_iterations,
                        result.iterations);
        x += x_.topRows<3>().transpose().cast<double>();
        if (!refines || error <= tolerance * whole(error) || !(error < kWorthRefining * before) ||
            result.iterations >= maximum_iterations) {
            break;
        }
        multigrid.residual(right_side, x, r_);
        set_zero(x_, r_.cols());
    }
    result.relative_error = error == 0 ? 0 : error / whole(error);
    result.reached_tolerance = result.relative_error <= tolerance;
    result.residual = norm(r_);
    return result;
}

}  // namespace tracked_mcf
