// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/control_groups.h"

#include <fstream>

namespace tracked_mcf {

std::vector<std::string> control_group_folders(const std::string& root) {
    const std::string mount = root + "/sys/fs/cgroup";
    // Inside a container, the path of the group may be one outside of it that does not exist here;
    // then the mount itself is the container's own group.
    std::vector<std::string> folders = {mount};
    std::ifstream groups(root + "/proc/self/cgroup");
    std::string line;
    while (std::getline(groups, line)) {
        if (line.rfind("0::", 0) != 0) continue;  // a hierarchy of cgroup v1
        const std::string path = mount + line.substr(3);
        for (std::size_t end = path.size(); end > mount.size(); end = path.rfind('/', end - 1)) {
            folders.push_back(path.substr(0, end));
        }
    }
    return folders;
}

}  // namespace tracked_mcf
