#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/morton.h"

namespace tracked_mcf {

/// Which fragments make up which element of the finest level: consecutive ones.
struct FinestElements {
    std::vector<MortonCode> cells;             ///< of every element, never decreasing
    std::vector<std::int64_t> fragment_begin;  ///< of every element, and the end
};

/// All that lies in a cell is one element, as in the paper. `fragments` as in ClippedSurface.
FinestElements one_element_per_cell(const RawVector<FragmentEntry>& fragments);

/// Every connected part of the surface in a cell is an element: fragments belong together whose
/// triangles share an edge of which a piece, or a vertex which, lies in the cell, its faces
/// included. Of the elements in a cell, the one with the first fragment comes first. Puts the
/// fragments, which are as in ClippedSurface, in the order of their elements.
FinestElements separate_sheets(const MeshTopology& topology, RawVector<FragmentEntry>& fragments);

}  // namespace tracked_mcf
