#pragma once

#include <string>

#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// What to tell a user of a flow that ended before it had made its `iterations` steps: at which,
/// why, and where something can be done about it, what. Empty if it made them all.
std::string early_stop(const FlowReport& report, int iterations);

}  // namespace tracked_mcf
