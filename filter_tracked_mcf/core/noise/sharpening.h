// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "filter_tracked_mcf/core/noise/smoothing.h"

namespace tracked_mcf {

/// How creases are sharpened.
struct Sharpening {
    double width = 0;    ///< length of differences of unit normals
    int iterations = 0;  ///< 0: not at all
};

/// Sharpens the creases of a smooth surface, which a step leaves a little round: averages the
/// normals of neighbouring triangles, those alike by `width` with most weight (Zheng, Fu, Au and
/// Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011), and moves the vertices to fit them
/// (Sun, Rosin, Martin and Langbein, "Fast and Effective Feature-Preserving Mesh Denoising", 2007).
/// Vertices start at `start`, and stay as near to the surface's positions as StepSettings::sideways
/// allows. They stop before one of them would leave `box`.
///
/// Calls take(i, positions) for each number of iterations. These increase, and share the first
/// ones.
void sharpen(const NoisySurface& surface, double width, const std::vector<int>& iterations,
             double sideways, const Eigen::AlignedBox3d& box, const Positions& start,
             const std::function<void(std::size_t, Positions)>& take);

}  // namespace tracked_mcf
