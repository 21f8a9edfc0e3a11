#pragma once

#include <string>

#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// What to tell a user of steps whose solver stopped short of `tolerance`: how many, which is the
/// worst, and how far it came. One sentence; empty if there are none. What to do is the host's to
/// say.
std::string shortfall(const FlowReport& report, double tolerance);

}  // namespace tracked_mcf
