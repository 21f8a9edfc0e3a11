#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::benchmark {

/// How the unknowns of the mesh's linear system are numbered: it decides how near in memory
/// neighbours are, and how good an incomplete factorisation is.
enum class VertexOrder {
    AsGiven,
    ReverseCuthillMcKee,  ///< breadth first from a vertex at the rim, the last one first
    Morton                ///< along a curve through the cells of an octree
};

/// "given", "rcm" or "morton". Throws std::invalid_argument for anything else.
VertexOrder parse_vertex_order(const std::string& name);

/// The mesh's vertices in that order.
std::vector<std::int32_t> ordered_vertices(const TriangleMesh& mesh, VertexOrder order);

}  // namespace tracked_mcf::benchmark
