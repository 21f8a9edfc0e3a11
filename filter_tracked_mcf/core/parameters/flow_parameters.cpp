// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow_parameters.h"

#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// Returns h / (1 - h), the square of k √δ for the waves whose amplitude the steps halve.
double halved_waves(int iterations, int order) {
    const double loss = -std::expm1(-std::log(2.0) / iterations);  // of the amplitude, per step
    const double h = std::pow(loss, 1.0 / order);
    return h / (1 - h);
}

constexpr double kTwoPi = 2 * kPi;

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

void validate(const FlowParameters& parameters) {
    check_ranges(parameters);
    check_range("cycles", parameters.cycles, {1, 1000, ""});
    if (parameters.method != Method::Paper) return;
    const auto refuse = [](const char* name) {
        throw InvalidParameter(
            name,
            "asks for what the method Paper does not have; leave it at its default, or take the "
            "method Converged.");
    };
    if (parameters.flow != FlowKind::MeanCurvature) refuse("flow");
    if (parameters.preserve != Preserve::None) refuse("preserve");
}

}  // namespace tracked_mcf
