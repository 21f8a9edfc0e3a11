// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// Returns whether all steps reached the tolerance.
bool converged(const FlowReport& report);

/// Returns warnings for a user, most with what to do.
std::vector<std::string> warnings_of(const FlowParameters& parameters, const FlowReport& report);

}  // namespace tracked_mcf
