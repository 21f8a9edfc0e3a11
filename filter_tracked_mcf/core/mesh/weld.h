// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns, per vertex, 1 if a triangle uses it, else 0.
std::vector<std::uint8_t> referenced_vertices(const TriangleMesh& mesh);

/// Returns, per referenced vertex, the smallest index of a referenced vertex at exactly the same
/// position, and per unreferenced vertex its own index. 0 and -0 are the same coordinate.
std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh,
                                                   const std::vector<std::uint8_t>& referenced);

}  // namespace tracked_mcf
