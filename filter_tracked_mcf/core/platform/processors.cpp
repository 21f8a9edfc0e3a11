// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/platform/processors.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "filter_tracked_mcf/core/platform/control_groups.h"

#ifdef __linux__
#include <sched.h>
#endif

namespace tracked_mcf {

namespace {

/// Returns on how many processors the scheduler may run this process.
int schedulable_processors() {
#ifdef __linux__
    cpu_set_t processors;
    if (sched_getaffinity(0, sizeof processors, &processors) == 0) return CPU_COUNT(&processors);
#endif
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

int processor_quota(const std::string& root) {
    int least = std::numeric_limits<int>::max();
    for (const std::string& folder : control_group_folders(root, "cpu")) {
        // Microseconds of processor time in each period, or the word "max"; in the first version
        // two files, and -1.
        double time = 0, period = 0;
        if (std::ifstream file(folder + "/cpu.max"); !(file >> time >> period)) {
            time = static_cast<double>(number_in(folder + "/cpu.cfs_quota_us").value_or(0));
            period = static_cast<double>(number_in(folder + "/cpu.cfs_period_us").value_or(0));
        }
        if (time <= 0 || period <= 0) continue;
        least = static_cast<int>(std::min<double>(least, std::ceil(time / period)));
    }
    return least;
}

int processor_count() {
    return std::min(schedulable_processors(), processor_quota(""));
}

}  // namespace tracked_mcf
