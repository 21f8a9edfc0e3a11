// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/clusters.h"
#include "filter_tracked_mcf/core/noise/cross_validation.h"

namespace tracked_mcf {

/// Returns clusters of vertices that are a little narrower than noise of some width, in edges, on a
/// sample.
Clusters clusters_of_width(const NoisySurface& surface, double width);

/// Returns the candidate of noise wider than an edge, as clusters show it. Clusters hide creases
/// that the mesh has, so its normals are smoothed less than theirs, unless the noise has creases.
/// The request and the choice are in edges of the mesh.
Choice candidate_of_width(const Clusters& clusters, NoiseRequest request);

}  // namespace tracked_mcf
