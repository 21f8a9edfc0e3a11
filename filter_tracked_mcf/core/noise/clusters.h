// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// A coarse surface whose vertices are the means of clusters of another one's.
struct Clusters {
    Sample sample;    ///< all of it; lengths are in its own edges
    double edge = 1;  ///< its mean edge, in edges of the other surface
};

/// Joins the vertices of a sample that are up to `radius` sides from each other, about. Neither the
/// clusters nor their signs depend on the order of the vertices.
Clusters clusters_of(const Sample& sample, int radius);

}  // namespace tracked_mcf
