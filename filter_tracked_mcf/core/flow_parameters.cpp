// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow_parameters.h"

#include <cmath>
#include <sstream>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

void check_range(const char* name, int value, int smallest, int largest, const char* note) {
    if (value >= smallest && value <= largest) return;
    throw InvalidParameter(std::string(name) + " is " + std::to_string(value) + "; give " +
                           std::to_string(smallest) + " to " + std::to_string(largest) + note +
                           ".");
}

std::string shortest(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

void check(bool fits, const char* name, double value, const std::string& what_to_give) {
    if (fits) return;
    throw InvalidParameter(std::string(name) + " is " + shortest(value) + "; give a number " +
                           what_to_give + ".");
}

}  // namespace

namespace {

/// Returns h / (1 - h), the square of k √δ for the waves whose amplitude the steps halve.
double halved_waves(int iterations, int order) {
    const double loss = -std::expm1(-std::log(2.0) / iterations);  // of the amplitude, per step
    const double h = std::pow(loss, 1.0 / order);
    return h / (1 - h);
}

const double kTwoPi = 2 * std::acos(-1.0);

}  // namespace

double step_size_for(double detail_size, int iterations, int order) {
    const double length = detail_size / kTwoPi;
    return length * length * halved_waves(iterations, order);
}

double detail_size_for(double step_size, int iterations, int order) {
    return kTwoPi * std::sqrt(step_size / halved_waves(iterations, order));
}

double detail_size_of(const FlowParameters& parameters, double mean_edge) {
    return parameters.detail_size > 0 ? parameters.detail_size : kDefaultDetailInEdges * mean_edge;
}

double stabilization_of(const FlowParameters& parameters) {
    const bool needed = parameters.solver == Solver::Converged;
    return parameters.stabilization.value_or(needed ? kDefaultStabilization : 0.0);
}

void validate(const FlowParameters& parameters) {
    check_range("depth", parameters.depth, 0, kMaximumDepth, ", where 0 chooses automatically");
    check_range("iterations", parameters.iterations, 1, kMaximumIterations, "");
    check_range("order", parameters.order, 1, kMaximumOrder, "");
    check_range("cycles", parameters.cycles, 1, kMaximumCycles, "");
    check_range("threads", parameters.threads, 0, kMaximumThreads,
                ", where 0 takes all that OpenMP offers");
    // Each comparison is written so that a NaN is refused.
    const double detail_size = parameters.detail_size;
    check(detail_size >= 0 && std::isfinite(detail_size), "detail_size", detail_size,
          "greater than 0, a length in units of the mesh, or 0 to take " +
              shortest(kDefaultDetailInEdges) + " mean edge lengths");
    const double step_size = parameters.step_size;
    if (parameters.absolute) {
        check(step_size >= 0 && std::isfinite(step_size), "step_size", step_size,
              "greater than 0, in squared units of the mesh, or 0 to take the detail size");
    } else {
        check(step_size >= 0 && step_size <= kMaximumStepSize, "step_size", step_size,
              "greater than 0 and at most " + shortest(kMaximumStepSize) +
                  ", such as 1e-5, or 0 to take the detail size");
    }
    if (parameters.quality == Quality::MeanCurvature &&
        parameters.flow != FlowKind::MeanCurvature) {
        throw InvalidParameter(
            "quality asks for the mean curvature, which a conformalized flow does not know; take "
            "the mean-curvature flow, or another quality.");
    }
    const double penalty = parameters.boundary_penalty;
    check(penalty > 0 && penalty <= kMaximumPenalty, "boundary_penalty", penalty,
          "greater than 0 and at most " + shortest(kMaximumPenalty) + ", such as 10");
    check(parameters.tolerance > 0 && parameters.tolerance < 1, "tolerance", parameters.tolerance,
          "greater than 0 and less than 1, such as 1e-3");
    const double weight = stabilization_of(parameters);
    check(weight >= 0 && weight <= kMaximumStabilization, "stabilization", weight,
          "from 0, which is none, to " + shortest(kMaximumStabilization) + ", such as " +
              shortest(kDefaultStabilization));
}

}  // namespace tracked_mcf
