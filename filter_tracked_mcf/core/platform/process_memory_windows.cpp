// SPDX-License-Identifier: GPL-3.0-or-later
// windows.h comes first: psapi.h needs its types.
#include <windows.h>
//
#include <psapi.h>

#include <algorithm>

#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

PROCESS_MEMORY_COUNTERS counters() {
    PROCESS_MEMORY_COUNTERS counters{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters;  // zeros if the call fails
}

}  // namespace

std::int64_t available_memory_bytes() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    if (GlobalMemoryStatusEx(&status) == 0) return 0;
    // The memory and page file that this process may still commit, and its free address space.
    const DWORDLONG bytes = std::min(status.ullAvailPageFile, status.ullAvailVirtual);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(bytes));
}

std::int64_t resident_memory_bytes() {
    return static_cast<std::int64_t>(counters().WorkingSetSize);
}

std::int64_t peak_memory_bytes() {
    return static_cast<std::int64_t>(counters().PeakWorkingSetSize);
}

}  // namespace tracked_mcf
