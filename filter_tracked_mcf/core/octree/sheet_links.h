// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/octree/octree.h"
#include "filter_tracked_mcf/core/octree/sheets.h"

namespace tracked_mcf {

/// Returns links between the elements of separate_sheets, sorted, each once. Two elements in
/// touching cells are linked if a triangle, an edge or a vertex has a piece in both. Some of these
/// links are left out where others connect the same elements inside the same supports.
///
/// The links keep the surface connected inside every support: a support is a box, so its part of a
/// triangle, an edge or a vertex is convex, and the pieces in any two of its touching cells are
/// connected in it. Edges and vertices matter where they lie in a grid plane: their triangles may
/// then lie in different cells, without any triangle in both.
RawVector<Link> find_links(const GridMesh& mesh, const MeshTopology& topology,
                           const RawVector<FragmentEntry>& fragments,
                           const FinestElements& elements);

}  // namespace tracked_mcf
