// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "filter_tracked_mcf/hosts/cli/command_line.h"

namespace tracked_mcf {

/// Returns the version, file names and report_values() as indented JSON.
std::string report_json(const CommandLineOf<FlowParameters>& line, const FlowReport& report,
                        const std::vector<std::string>& warnings);
std::string report_json(const CommandLineOf<NoiseParameters>& line, const NoiseReport& report,
                        const std::vector<std::string>& warnings);
std::string report_json(const CommandLineOf<FairParameters>& line, const FairReport& report,
                        const std::vector<std::string>& warnings);

}  // namespace tracked_mcf
