// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Vertices that move together, and three rings of the surface around them, which are held.
struct Patch {
    std::vector<std::int32_t> vertices;  ///< of the surface: those that move, then ring by ring
    std::int32_t moving = 0;             ///< number of vertices that move
    std::int32_t held = 0;               ///< end of the first ring, which holds them
    std::int32_t inner = 0;  ///< end of the second ring: vertices before it have whole stars
    std::vector<std::uint8_t> has_normal;  ///< per vertex: whether all its edges have two triangles
    std::vector<Triangle> triangles;       ///< indices into `vertices`
};

/// Returns the patches of the vertices of a surface that move. Patches have no vertex in common.
/// Throws InvalidMesh if fewer than three vertices hold a connected part of those that move.
std::vector<Patch> patches_of(const Stars& stars, const std::vector<std::uint8_t>& moves);

}  // namespace tracked_mcf
