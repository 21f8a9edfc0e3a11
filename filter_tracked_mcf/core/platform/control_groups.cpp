// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/platform/control_groups.h"

#include <fstream>
#include <sstream>

namespace tracked_mcf {

namespace {

/// Returns whether a list such as "cpu,cpuacct" has a word.
bool has_word(const std::string& list, const std::string& word) {
    std::istringstream words(list);
    for (std::string one; std::getline(words, one, ',');) {
        if (one == word) return true;
    }
    return false;
}

}  // namespace

std::vector<std::string> control_group_folders(const std::string& root,
                                               const std::string& controller) {
    const std::string second = root + "/sys/fs/cgroup", first = second + '/' + controller;
    // Inside a container, the path of the group may be one outside of it that does not exist here;
    // then the mount itself is the container's own group.
    std::vector<std::string> folders = {second, first};
    std::ifstream groups(root + "/proc/self/cgroup");
    // A line is "number:controllers:path"; v2 has no controllers.
    for (std::string line; std::getline(groups, line);) {
        const std::size_t begin = line.find(':'), end = line.find(':', begin + 1);
        if (begin == std::string::npos || end == std::string::npos) continue;
        const std::string controllers = line.substr(begin + 1, end - begin - 1);
        if (!controllers.empty() && !has_word(controllers, controller)) continue;
        const std::string& mount = controllers.empty() ? second : first;
        const std::string path = mount + line.substr(end + 1);
        for (std::size_t size = path.size(); size > mount.size();
             size = path.rfind('/', size - 1)) {
            folders.push_back(path.substr(0, size));
        }
    }
    return folders;
}

std::optional<std::int64_t> number_in(const std::string& file, const std::string& name) {
    std::ifstream stream(file);
    std::string word;
    while (word != name) {
        if (!(stream >> word)) return {};
    }
    std::int64_t number = 0;
    if (stream >> number) return number;
    return {};
}

}  // namespace tracked_mcf
