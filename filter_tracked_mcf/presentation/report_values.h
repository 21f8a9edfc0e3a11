// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

struct ReportValue;
using ReportList = std::vector<ReportValue>;
using ReportObject = std::vector<std::pair<std::string, ReportValue>>;

/// A value of a report in any notation: JSON and Python have all these types. std::monostate is
/// null.
struct ReportValue {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, ReportList, ReportObject>
        value;
};

/// Returns the parameters and then the `inputs`, the warnings, and the flow's report under its
/// names in the code, without the quality and what only warnings and summary() use. It has also
/// `converged` and `volume_after`. W-cycles have no tolerance:
/// error_estimate and reached_tolerance of their steps are null.
ReportObject report_values(const FlowParameters& parameters, const ReportObject& inputs,
                           const FlowReport& report, const std::vector<std::string>& warnings);

/// Returns the same of a removal of noise.
ReportObject report_values(const NoiseParameters& parameters, const ReportObject& inputs,
                           const NoiseReport& report, const std::vector<std::string>& warnings);

/// Returns the same of faired patches.
ReportObject report_values(const FairParameters& parameters, const ReportObject& inputs,
                           const FairReport& report, const std::vector<std::string>& warnings);

}  // namespace tracked_mcf
