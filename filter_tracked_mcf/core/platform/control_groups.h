// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tracked_mcf {

/// Returns the folders of this process's control groups and of their parents (Linux), whose files
/// limit its resources: those of cgroup v2, and those of a controller of v1, such as "memory".
/// Paths follow `root`: a test's folder or "". Folders may not exist.
std::vector<std::string> control_group_folders(const std::string& root,
                                               const std::string& controller);

/// Returns the number that follows the word `name` in a file, or the file's first number if `name`
/// is empty. Returns nothing if a word such as "max" stands in its place.
std::optional<std::int64_t> number_in(const std::string& file, const std::string& name = "");

}  // namespace tracked_mcf
