// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::benchmark {

/// The numbering of the unknowns of the mesh's linear system. It determines the distance of
/// neighbours in memory and the quality of an incomplete factorisation.
enum class VertexOrder {
    AsGiven,
    ReverseCuthillMcKee,  ///< breadth first, in reverse
    Morton                ///< along a Morton curve through the cells of an octree
};

/// Parses "given", "rcm" or "morton". Throws std::invalid_argument for any other name.
VertexOrder parse_vertex_order(const std::string& name);

/// Returns the mesh's vertices in this order.
std::vector<std::int32_t> ordered_vertices(const TriangleMesh& mesh, VertexOrder order);

}  // namespace tracked_mcf::benchmark
