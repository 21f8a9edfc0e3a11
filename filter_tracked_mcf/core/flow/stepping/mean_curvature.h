// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/flow/stepping/flow_surface.h"

namespace tracked_mcf {

/// Returns the mean curvature of a surface at each vertex of the mesh, see Quality::MeanCurvature;
/// 0 at those that no triangle uses. It is measured also at vertices that stay, smoothed as by a
/// step of two squared edges, and continued to the boundary from beside it.
std::vector<double> mean_curvatures_of(const FlowSurface& surface);

}  // namespace tracked_mcf
