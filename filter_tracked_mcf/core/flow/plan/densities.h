// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// A smaller mean strength of a triangle's vertices acts like this one: even here, the surface
/// moves by a millionth of what it would with strength 1.
inline constexpr double kLeastStrength = 1e-3;

/// Returns the mass density of each triangle of a surface; nothing if all are 1. In
/// equation 2, a density ρ acts like a time step δ / ρ, so it is 1 / s² where s is the mean
/// strength of the vertices.
std::vector<float> triangle_densities(const Surface& surface);

}  // namespace tracked_mcf
