// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/cells/grid.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/domain.h"

namespace tracked_mcf {

/// Returns the expected peak of the memory, in bytes, that the paper's flow of a domain takes on a
/// grid besides the mesh. It was 0.87 to 2.1 times the peak for 230 flows, and up to 4.2 times for
/// copies of triangles, which count as often as they are there, though they share elements.
double paper_flow_bytes(const Domain& domain, const Grid& grid, Cubature cubature, int order);

}  // namespace tracked_mcf
