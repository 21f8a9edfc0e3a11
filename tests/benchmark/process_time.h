#pragma once

#include "filter_tracked_mcf/core/stopwatch.h"

namespace tracked_mcf::benchmark {

/// Processor time of all threads of this process so far, seconds.
double cpu_seconds();

/// Seconds that have passed, and those that all threads together have worked.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};

/// Both since it was made.
class ProcessStopwatch {
public:
    Seconds seconds() const { return {wall_.seconds(), cpu_seconds() - cpu_start_}; }

private:
    Stopwatch wall_;
    double cpu_start_ = cpu_seconds();
};

}  // namespace tracked_mcf::benchmark
