// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// Returns the expected peak of the memory, in bytes, that the paper's flow of a surface takes on a
/// grid besides the mesh. `positions` are those of the surface, in the unit of the grid. It was
/// 0.92 to 2.1 times the peak for 212 flows.
double paper_flow_bytes(const Surface& surface, const Positions& positions, const Grid& grid,
                        Cubature cubature, int order);

}  // namespace tracked_mcf
