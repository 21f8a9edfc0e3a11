#pragma once

#include <filesystem>

namespace tracked_mcf {

/// Throws UnreadableFile unless the file is a complete binary or ASCII STL. vcglib's reader trusts
/// the number of triangles that a binary file states, and searches ASCII files for line ends that
/// may never come.
void check_stl(const std::filesystem::path& path);

}  // namespace tracked_mcf
