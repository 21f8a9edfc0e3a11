// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// Returns the mean curvature of a surface at each vertex of the mesh, see Quality::MeanCurvature;
/// 0 at those that no triangle uses. `positions` are those of the surface's vertices, in edges. It
/// is measured also at held vertices, smoothed as by a step of two squared edges, and continued to
/// the rim from inside; in a part without a vertex inside, it is measured at the rim.
std::vector<double> mean_curvatures_of(const Surface& surface, const Positions& positions);

}  // namespace tracked_mcf
