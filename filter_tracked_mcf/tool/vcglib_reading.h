#pragma once

#include <filesystem>

#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/vcglib_mesh.h"

namespace tracked_mcf {

/// Reads OBJ, OFF or STL with vcglib's reader, and a PLY from its document. `document` is the file
/// as it was checked, or null for STL. Returns vcglib's mask of what the mesh has. Throws
/// UnreadableFile.
int read_with_vcglib(const std::filesystem::path& path, const MeshDocument* document,
                     VcglibMesh& mesh);

}  // namespace tracked_mcf
