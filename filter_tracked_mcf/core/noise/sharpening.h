// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// Sharpens the creases of a smooth surface, which a step leaves a little round: averages the
/// normals of neighbouring triangles `iterations` times, those alike by `width` with most weight
/// (Zheng, Fu, Au and Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011), and moves the
/// vertices to fit them (Sun, Rosin, Martin and Langbein, "Fast and Effective Feature-Preserving
/// Mesh Denoising", 2007). `width` is a length of differences of unit normals. `surface` has the
/// stars and the fidelities.
void sharpen(const NoisySurface& surface, double width, int iterations, Positions& positions);

}  // namespace tracked_mcf
