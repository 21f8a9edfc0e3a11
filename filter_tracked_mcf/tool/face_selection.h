#pragma once

#include <string>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/tool/documents/ply_document.h"

namespace tracked_mcf {

/// Of every triangle that a PLY file's polygons fall into, in their order, whether it is selected
/// by the property `name`: a number, of the faces if they have it, else of the vertices. A face is
/// selected if its number is not zero, or if those of all its vertices are not. Of `flags`, which
/// is where MeshLab keeps a selection, only the bit of that counts.
///
/// Throws InvalidParameter if there is no such property, InvalidMesh if it selects nothing; both
/// call the file `file`.
Selection selected_triangles(const PlyDocument& document, const std::string& name,
                             const std::string& file);

}  // namespace tracked_mcf
