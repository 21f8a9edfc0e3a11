// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns lines for a person, as far as the filter knows: what it did and in which time, how far
/// vertices moved, the change of area and volume, and which faces or vertices did not take part.
std::string summary(const FlowParameters& parameters, const FlowReport& report);
std::string summary(const NoiseParameters& parameters, const NoiseReport& report);
std::string summary(const FairParameters& parameters, const FairReport& report);

/// Returns lines with the numbers of the solver and, if the filter has one, of the grid.
std::string solver_details(const FlowParameters& parameters, const FlowReport& report);
std::string solver_details(const NoiseParameters& parameters, const NoiseReport& report);
std::string solver_details(const FairParameters& parameters, const FairReport& report);

}  // namespace tracked_mcf
