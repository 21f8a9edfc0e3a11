#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/progress.h"
#include "tests/benchmark/process_time.h"

namespace tracked_mcf::benchmark {

/// Measures the phases of a set-up as a callback is told of them.
class SetupTimes {
public:
    /// To be given to a ProgressMeter; this must outlive it.
    Progress progress();

    /// The last phase is over. Returns all with their times, in order.
    const std::vector<std::pair<std::string, Seconds>>& finish();

private:
    void enter(std::string_view phase);

    std::string phase_;
    ProcessStopwatch since_entered_;
    std::vector<std::pair<std::string, Seconds>> times_;
};

}  // namespace tracked_mcf::benchmark
