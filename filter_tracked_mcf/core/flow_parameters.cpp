// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow_parameters.h"

#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"

namespace tracked_mcf {

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

Discretisation discretisation_of(const FlowParameters& parameters) {
    const bool whole =
        parameters.cubature == Cubature::ThreePoints && parameters.solver != Solver::OneWCycle;
    return {parameters.cubature, whole, parameters.separate_sheets};
}

double stabilization_of(const FlowParameters& parameters) {
    const bool needed = parameters.solver != Solver::OneWCycle;
    return parameters.stabilization.value_or(needed ? kDefaultStabilization : 0.0);
}

void validate(const FlowParameters& parameters) {
    check_ranges(parameters);
    if (parameters.quality == Quality::MeanCurvature &&
        parameters.flow != FlowKind::MeanCurvature) {
        throw InvalidParameter(
            "quality",
            "asks for the mean curvature, which a conformalized flow does not know; take "
            "the mean-curvature flow, or another quality.");
    }
}

}  // namespace tracked_mcf
