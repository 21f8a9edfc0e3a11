#pragma once

#include <vector>

#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/links.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/sheets.h"

namespace tracked_mcf {

/// Links between separated elements, sorted, each once: all that there are, or others that lead
/// from one element to the other inside the same supports. The supports of functions are boxes, so
/// what a support and a triangle, an edge or a vertex have in common is convex: its pieces in any
/// two touching cells are connected inside every support that has both cells. Edges and vertices
/// matter where they lie in a grid plane: their triangles may then be in different cells, and no
/// triangle in both.
RawVector<Link> find_links(const GridMesh& mesh, const MeshTopology& topology,
                           const RawVector<FragmentEntry>& fragments,
                           const FinestElements& elements);

}  // namespace tracked_mcf
