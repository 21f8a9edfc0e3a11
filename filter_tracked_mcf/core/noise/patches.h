// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Vertices that move together, and three rings of the surface around them, which stays.
struct Patch {
    std::vector<std::int32_t> vertices;    ///< of the mesh; those that move come first
    std::int32_t moving = 0;               ///< number of vertices that move
    std::int32_t held = 0;                 ///< end of the first ring, which holds them
    std::int32_t inner = 0;                ///< end of the second ring: inner ones have whole stars
    std::vector<std::uint8_t> has_normal;  ///< per vertex: whether the surface has two sides there
    std::vector<Triangle> triangles;       ///< with a vertex of these, as indices into `vertices`
};

/// Returns, per vertex of the mesh, whether it is an inner vertex of the selection, see fair().
/// Coincident vertices count as their first one alone.
std::vector<std::uint8_t> inner_vertices(const MeshTopology& topology, const Selection& selection);

/// Returns the patches of the vertices that move. Vertices of different patches do not occur in the
/// same equation, whatever the continuity. Throws InvalidMesh if nothing holds a part of them.
std::vector<Patch> patches_of(const MeshTopology& topology, const std::vector<std::uint8_t>& moves);

}  // namespace tracked_mcf
