// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// Returns whether all steps reached the tolerance.
bool converged(const FlowReport& report);

/// Returns up to five warnings for a user. If the flow stopped before its last step: where, why,
/// and what to do. If the step size was limited, the cells are too wide for the detail size, or a
/// step removed more than a tenth of the area: how far, and what to do. If steps did not reach the
/// tolerance: how many, which is the worst, its error estimate, and then `advice`, in which the
/// host says what to do.
std::vector<std::string> warnings_of(const FlowParameters& parameters, const FlowReport& report,
                                     const std::string& advice);

}  // namespace tracked_mcf
