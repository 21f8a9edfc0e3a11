#pragma once

#include "filter_tracked_mcf/tool/documents/ply_document.h"
#include "filter_tracked_mcf/tool/vcglib_mesh.h"

namespace tracked_mcf {

/// Makes of a PLY file the mesh that vcglib's reader makes of it, for conversion to other formats:
/// polygons as fans, colours, texture coordinates. Returns vcglib's mask of what is there.
///
/// vcglib's own reader is not used, because of files that are well formed: it takes big-endian
/// doubles as they are, skips lists only if they are counted in one byte and not empty, does not
/// know indices of all types, refuses texture coordinates on polygons, and writes texture
/// coordinates, colours and texture names into arrays without a look at their sizes.
int ply_to_vcglib(const PlyDocument& document, VcglibMesh& mesh);

}  // namespace tracked_mcf
