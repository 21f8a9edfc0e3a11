// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/memory/memory_check.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the least depth, 1 to kMaximumDepth, at which the cells of the grid's cube resolve the
/// detail size: a cell is at most about as wide as it if it is at least the default, else at most
/// half as wide, and a third as wide if edges are kept. Returns 0 if the parameters give a step
/// size: its caller knows the grid.
int resolving_depth(const SurfaceView& mesh, const Grid& grid, const FlowParameters& parameters);

/// Clips the mesh to `cube` (a grid of depth 0) at the depth, 1 to kMaximumDepth, whose number of
/// unknowns is nearest to `vertices`. If that depth is less than `least_depth`, the depth is up to
/// two greater, as far as the flow fits into the memory. It is 1 if all triangles are degenerate.
///
/// The unknowns without separate sheets are counted, at the depths that can decide, assuming that
/// each depth has at least twice as many as the one before. MemoryCheck::separate_unknowns()
/// replaces the count where it is much larger. Throws what clip_to_grid throws, and NotEnoughMemory
/// if clipping does not fit.
ClippedSurface clip_at_automatic_depth(const SurfaceView& mesh, const Grid& cube,
                                       std::int64_t vertices, int least_depth,
                                       const MemoryCheck& memory);

}  // namespace tracked_mcf
