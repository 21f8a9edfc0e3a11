// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/smoothing.h"

namespace tracked_mcf {

/// How creases are sharpened.
struct Sharpening {
    double width = 0;    ///< length of differences of unit normals
    int iterations = 0;  ///< 0: not at all
};

/// Sharpens the creases of a smooth surface, which a step leaves a little round: averages the
/// normals of neighbouring triangles, those alike by the width with most weight (Zheng, Fu, Au and
/// Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011), and moves the vertices to fit them
/// (Sun, Rosin, Martin and Langbein, "Fast and Effective Feature-Preserving Mesh Denoising", 2007).
/// Vertices start at the surface's positions, and are as far from these as StepSettings::sideways
/// allows. They stop before one of them would leave `box`.
void sharpen(const NoisySurface& surface, const Sharpening& sharpening, double sideways,
             const Eigen::AlignedBox3d& box, Positions& positions);

}  // namespace tracked_mcf
