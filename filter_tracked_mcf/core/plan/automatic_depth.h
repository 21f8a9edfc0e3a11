// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/plan/memory_check.h"
#include "filter_tracked_mcf/core/plan/memory_estimate.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the least depth at which the cells of the grid's cube resolve the detail size, but at
/// most kMaximumDepth. Cells resolve a detail size less than the default if they are at most half
/// as wide, and a greater one if they are at most 1.1 times as wide. Lengths are in mesh units.
int resolving_depth(double detail_size, double mean_edge, const Grid& grid);

/// Clips the domain's surface, of this size, to `cube` (a grid of depth 0) at the depth, 1 to
/// kMaximumDepth, whose expected number of unknowns is nearest to the number of vertices. It is
/// less where threads thinner than a cell have many more, and 1 if no triangle has an area. If that
/// depth is less than `least_depth`, the depth is up to two greater, as far as the flow fits into
/// the memory. Throws what clip_to_grid throws, and NotEnoughMemory if the flow does not fit.
ClippedSurface clip_at_automatic_depth(const Domain& domain, const SurfaceSize& size,
                                       const Grid& cube, int least_depth,
                                       const MemoryCheck& memory);

}  // namespace tracked_mcf
