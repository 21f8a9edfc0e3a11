#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/tool/command_line.h"

namespace tracked_mcf {

/// What was asked for and what was done, as indented JSON: the version, file names, parameters
/// and every member of the flow's report, under the names that they have in the code. The
/// stabilisation is the one used, whether asked for or not. W-cycles know no tolerance: what steps
/// say of it is then null.
std::string report_json(const CommandLine& line, const FlowReport& report);

/// The same for a person, in a few lines.
std::string summary(const CommandLine& line, const FlowReport& report);

/// What the person must know even if no summary is wanted: a line each.
std::vector<std::string> warnings(const CommandLine& line, const FlowReport& report);

}  // namespace tracked_mcf
