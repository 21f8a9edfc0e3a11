// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmark/process_time.h"

#include <ctime>

namespace tracked_mcf::benchmark {

double cpu_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace tracked_mcf::benchmark
