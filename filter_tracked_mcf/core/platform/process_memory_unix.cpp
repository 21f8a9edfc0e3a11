// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "filter_tracked_mcf/core/platform/control_groups.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

std::int64_t free_in_machine(const std::string& root) {
    const std::string file = root + "/proc/meminfo";
    const auto available = number_in(file, "MemAvailable:");
    if (!available) return kUnlimited;
    // A flow that swaps is slow, but it is allowed.
    return std::int64_t{1024} * (*available + number_in(file, "SwapFree:").value_or(0));
}

/// Returns what the limit of one control group leaves. Pages of files, which the kernel takes back
/// when it needs them, count as free.
std::int64_t free_in_folder(const std::string& folder) {
    const auto one_of = [&](const char* second_version, const char* first_version) {
        const auto number = number_in(folder + second_version);
        return number ? number : number_in(folder + first_version);
    };
    const auto limit = one_of("/memory.max", "/memory.limit_in_bytes");
    const auto use = one_of("/memory.current", "/memory.usage_in_bytes");
    if (!limit || !use) return kUnlimited;
    std::int64_t reclaimable = 0;
    for (const char* const kind : {"inactive_file", "active_file", "slab_reclaimable"}) {
        const std::string file = folder + "/memory.stat";
        // In the first version, these are the numbers with those of groups inside.
        const auto of_all = number_in(file, std::string("total_") + kind);
        reclaimable += of_all.value_or(number_in(file, kind).value_or(0));
    }
    return *limit - std::max<std::int64_t>(0, *use - reclaimable);
}

std::int64_t free_in_groups(const std::string& root) {
    std::int64_t least = kUnlimited;
    for (const std::string& folder : control_group_folders(root, "memory")) {
        least = std::min(least, free_in_folder(folder));
    }
    return least;
}

/// Returns what a limit of this process leaves if `pages` count towards the limit.
template <class Resource>
std::int64_t free_under(Resource resource, std::int64_t pages) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur >= rlim_t{kUnlimited}) return kUnlimited;
    return static_cast<std::int64_t>(limit.rlim_cur) - pages * sysconf(_SC_PAGESIZE);
}

std::int64_t free_in_process() {
    std::ifstream statm("/proc/self/statm");
    std::int64_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
    if (!(statm >> size >> resident >> shared >> text >> library >> data)) return kUnlimited;
    return std::min(free_under(RLIMIT_AS, size), free_under(RLIMIT_DATA, data));
}

std::int64_t known_or_zero(std::int64_t bytes) {
    return bytes == kUnlimited ? 0 : std::max<std::int64_t>(1, bytes);
}

}  // namespace

std::int64_t available_memory_by_files(const std::string& root) {
    return known_or_zero(std::min(free_in_machine(root), free_in_groups(root)));
}

std::int64_t available_memory_bytes() {
    const std::int64_t by_files = available_memory_by_files("");
    return known_or_zero(std::min(by_files == 0 ? kUnlimited : by_files, free_in_process()));
}

std::int64_t resident_memory_bytes() {
    return std::int64_t{1024} * number_in("/proc/self/status", "VmRSS:").value_or(0);
}

std::int64_t peak_memory_bytes() {
    // The peak that getrusage() reports may be that of the program that started this one.
    if (const auto peak = number_in("/proc/self/status", "VmHWM:"))
        return std::int64_t{1024} * *peak;
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    constexpr std::int64_t unit = 1;
#else
    constexpr std::int64_t unit = 1024;
#endif
    return unit * usage.ru_maxrss;
}

}  // namespace tracked_mcf
