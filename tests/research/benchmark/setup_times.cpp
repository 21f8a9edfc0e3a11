// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/setup_times.h"

namespace tracked_mcf::benchmark {

Progress SetupTimes::progress() {
    return [this](double, std::string_view phase) {
        enter(phase);
        return true;
    };
}

/// The callback is called several times in each phase.
void SetupTimes::enter(std::string_view phase) {
    if (phase == phase_) return;
    if (!phase_.empty()) times_.emplace_back(phase_, since_entered_.seconds());
    phase_ = phase;
    since_entered_ = ProcessStopwatch();
}

const std::vector<std::pair<std::string, Seconds>>& SetupTimes::finish() {
    enter("");
    return times_;
}

}  // namespace tracked_mcf::benchmark
