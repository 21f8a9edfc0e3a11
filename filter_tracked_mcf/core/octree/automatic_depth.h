// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/memory/memory_check.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Clips the mesh to `cube` (a grid of depth 0) at the depth, 1 to kMaximumDepth, whose number of
/// unknowns is nearest to `vertices`. The depth is 1 if all triangles are degenerate.
///
/// The unknowns without separate sheets are counted, at the depths that can decide, assuming that
/// each depth has at least twice as many as the one before. MemoryCheck::separate_unknowns()
/// replaces the count where it is much larger. Throws what clip_to_grid throws, and NotEnoughMemory
/// if clipping does not fit.
ClippedSurface clip_at_automatic_depth(const TriangleMesh& mesh, const Grid& cube,
                                       std::int64_t vertices, const MemoryCheck& memory);

}  // namespace tracked_mcf
