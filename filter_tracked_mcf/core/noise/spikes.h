// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// A single vertex that stands far out of the surface around it.
struct Spike {
    std::int32_t vertex = 0;
    Eigen::Vector3d place;  ///< where the vertices around it would have it
};

/// Returns the spikes of a surface: free vertices inside it that are farther from the plane of
/// their neighbours than these are apart, and many times as far as the vertices around are from
/// theirs.
std::vector<Spike> spikes_of(const NoisySurface& surface);

}  // namespace tracked_mcf
