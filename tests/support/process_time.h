// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

/// Returns the processor time of all threads of this process so far, in seconds.
inline double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Wall time, and processor time of all threads, in seconds.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};

/// Measures both since its construction.
class ProcessStopwatch {
public:
    Seconds seconds() const { return {wall_.seconds(), cpu_seconds() - cpu_start_}; }

private:
    Stopwatch wall_;
    double cpu_start_ = cpu_seconds();
};

}  // namespace tracked_mcf
