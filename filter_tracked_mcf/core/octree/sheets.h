// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"

namespace tracked_mcf {

/// The elements of the finest level. Each consists of consecutive fragments.
struct FinestElements {
    std::vector<MortonCode> cells;             ///< per element, never decreasing
    std::vector<std::int64_t> fragment_begin;  ///< per element, and the end
};

/// Returns one element per cell, as in the paper. `fragments` are those of a ClippedSurface.
FinestElements one_element_per_cell(const RawVector<FragmentEntry>& fragments);

/// Returns one element per sheet. A sheet is a connected part of the surface in a cell: two
/// fragments belong to one sheet if their triangles share a vertex, or part of an edge, inside the
/// closed cell.
///
/// Reorders `fragments`, which are those of a ClippedSurface, so that each element's fragments are
/// consecutive. The elements of a cell are ordered by their first fragments.
FinestElements separate_sheets(const MeshTopology& topology, RawVector<FragmentEntry>& fragments);

}  // namespace tracked_mcf
