// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// What connected parts of a surface have lost, besides their noise.
struct Losses {
    std::int64_t parts = 0;  ///< number of parts that have lost too much
    double area = 0;         ///< largest share of a part's area
    double volume = 0;       ///< largest change of the volume of a closed part, relative to it
};

/// Compares the parts of a surface with what they are at other positions.
///
/// Noise makes an area larger, and its removal is no loss. So the area before is that of the
/// triangles seen along their normals afterwards. Noise hardly changes a volume, or how far a part
/// spreads. Parts whose size is near `rounding`, that of positions, are left out.
Losses losses_of(const NoisySurface& before, const Positions& after, double rounding);

}  // namespace tracked_mcf
