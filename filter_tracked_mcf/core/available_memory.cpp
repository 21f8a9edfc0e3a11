#include "filter_tracked_mcf/core/available_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace tracked_mcf {

namespace {

constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

/// The number that follows `name` in a file of names and numbers, one pair a line.
std::optional<std::int64_t> number_named(const std::string& file, const std::string& name) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string word;
        std::int64_t number = 0;
        if (words >> word >> number && word == name) return number;
    }
    return {};
}

/// The number that a file consists of; none if it is another word, such as "max".
std::optional<std::int64_t> number_in(const std::string& file) {
    std::ifstream stream(file);
    std::int64_t number = 0;
    if (stream >> number) return number;
    return {};
}

std::int64_t free_in_machine(const std::string& root) {
    const std::string file = root + "/proc/meminfo";
    const auto available = number_named(file, "MemAvailable:");
    if (!available) return kUnlimited;
    // Who has swap space may use it: slow, but not refused.
    return std::int64_t{1024} * (*available + number_named(file, "SwapFree:").value_or(0));
}

/// How a version of control groups calls its files.
struct GroupFiles {
    const char* mount;
    const char* limit;
    const char* use;
    const char* inactive_files;  ///< in memory.stat: what of the use is given back when needed
};

constexpr GroupFiles kVersion1 = {"/sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                  "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"/sys/fs/cgroup", "memory.max", "memory.current",
                                  "inactive_file"};

std::int64_t free_in_folder(const std::string& folder, const GroupFiles& files) {
    const auto limit = number_in(folder + "/" + files.limit);
    const auto use = number_in(folder + "/" + files.use);
    if (!limit || !use) return kUnlimited;
    const auto reclaimable = number_named(folder + "/memory.stat", files.inactive_files);
    return *limit - std::max<std::int64_t>(0, *use - reclaimable.value_or(0));
}

/// In a control group and all that it is part of. Inside a container the path may be one of the
/// machine outside; then the container's own group is the mount itself.
std::int64_t free_in_group(const std::string& root, std::string path, const GroupFiles& files) {
    const std::string mount = root + files.mount;
    std::int64_t least = kUnlimited;
    for (;;) {
        while (!path.empty() && path.back() == '/') path.pop_back();
        least = std::min(least, free_in_folder(mount + path, files));
        if (path.empty()) return least;
        path.erase(path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/'));
    }
}

std::int64_t free_in_groups(const std::string& root) {
    std::int64_t least = kUnlimited;
    std::ifstream groups(root + "/proc/self/cgroup");
    // Number, controllers, path, between colons; version 2 names no controllers.
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        if (first == std::string::npos) continue;
        const std::size_t second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const std::string path = line.substr(second + 1);
        if (controllers == ",,") least = std::min(least, free_in_group(root, path, kVersion2));
        if (controllers.find(",memory,") != std::string::npos) {
            least = std::min(least, free_in_group(root, path, kVersion1));
        }
    }
    return least;
}

#if __has_include(<sys/resource.h>)
/// What a limit of this process leaves, given how many pages count for it.
template <class Resource>
std::int64_t free_under(Resource resource, std::int64_t pages) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
    if (limit.rlim_cur > static_cast<rlim_t>(kUnlimited)) return kUnlimited;
    return static_cast<std::int64_t>(limit.rlim_cur) - pages * sysconf(_SC_PAGESIZE);
}

std::int64_t free_in_process() {
    std::ifstream statm("/proc/self/statm");
    std::int64_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
    if (!(statm >> size >> resident >> shared >> text >> library >> data)) return kUnlimited;
    return std::min(free_under(RLIMIT_AS, size), free_under(RLIMIT_DATA, data));
}
#else
std::int64_t free_in_process() {
    return kUnlimited;
}
#endif

std::int64_t known_or_zero(std::int64_t bytes) {
    return bytes == kUnlimited ? 0 : std::max<std::int64_t>(1, bytes);
}

}  // namespace

std::int64_t available_memory_by_files(const std::string& root) noexcept {
    try {
        const std::string prefix = root == "/" ? "" : root;
        return known_or_zero(std::min(free_in_machine(prefix), free_in_groups(prefix)));
    } catch (...) {
        return 0;
    }
}

std::int64_t available_memory_bytes() noexcept {
    const std::int64_t by_files = available_memory_by_files("/");
    try {
        return known_or_zero(std::min(by_files == 0 ? kUnlimited : by_files, free_in_process()));
    } catch (...) {
        return by_files;
    }
}

}  // namespace tracked_mcf
