// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns the positions of a surface's vertices without their noise, and reports on it. `edge` is
/// the length of an edge in mesh units. Changes fidelities meanwhile.
///
/// A sample shows which candidate suits the whole surface. Single places then choose among a few.
/// Where noise varies, or single vertices have much more of it, the surface is smoothed with
/// fidelities instead.
Positions denoised(NoisySurface& surface, double edge, const NoiseParameters& parameters,
                   NoiseReport& report);

/// Returns the length of the difference of two unit normals across a crease of this angle, in
/// degrees.
double crease_of(double angle);

}  // namespace tracked_mcf
