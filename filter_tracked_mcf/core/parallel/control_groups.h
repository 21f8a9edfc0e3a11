// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tracked_mcf {

/// Returns the folders of this process's control group and of its parents (Linux, cgroup v2), whose
/// files limit its resources. Paths follow `root`: a test's folder or "". Folders may not exist.
std::vector<std::string> control_group_folders(const std::string& root);

}  // namespace tracked_mcf
