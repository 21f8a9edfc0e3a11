// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns the positions of a surface's vertices without their noise, and reports on it. `edge` is
/// the length of an edge in mesh units, and `rounding` the error of a position, in edges. Changes
/// fidelities meanwhile.
///
/// A sample shows which candidate suits the whole surface. Single places then choose among a few.
/// Where noise varies, or single vertices have much more of it, the surface is smoothed with
/// fidelities instead.
Positions denoised(NoisySurface& surface, double edge, double rounding,
                   const NoiseParameters& parameters, NoiseReport& report);

}  // namespace tracked_mcf
