#pragma once

#include <filesystem>

#include "filter_tracked_mcf/tool/vcglib_mesh.h"

namespace tracked_mcf {

/// Writes with vcglib's writer for the extension what of `mask` the format can carry. Returns
/// whether it succeeded, as far as vcglib notices: not if the last bytes did not fit on the disk.
/// Its text formats have few digits.
bool write_with_vcglib(VcglibMesh& mesh, int mask, const std::filesystem::path& file);

}  // namespace tracked_mcf
