// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/progress.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::benchmark {

/// Measures the phases of a set-up by the names that the progress callback receives.
class SetupTimes {
public:
    /// Returns the callback for a ProgressMeter. This object must outlive the meter.
    Progress progress();

    /// Ends the last phase. Returns all phases with their times, in order.
    const std::vector<std::pair<std::string, Seconds>>& finish();

private:
    void enter(std::string_view phase);

    std::string phase_;
    ProcessStopwatch since_entered_;
    std::vector<std::pair<std::string, Seconds>> times_;
};

}  // namespace tracked_mcf::benchmark
