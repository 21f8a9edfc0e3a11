// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// What a connected part of a surface has lost, besides its noise.
struct PartLoss {
    double area = 0;    ///< share of the area
    double volume = 0;  ///< change of the volume of a closed part, relative to it
    /// As much of these as may come from noise: a fifth of the area that it adds, because it also
    /// hides what is as fine; and three standard errors of the volume, if the movements of vertices
    /// are independent.
    double area_of_noise = 0, volume_of_noise = 0;
    std::int64_t turned = 0;  ///< triangles that are folded, and were not before
    double turned_area = 0;   ///< share of the area that they had

    /// Returns whether it has lost more than 3 % of its area or volume besides its noise, or more
    /// than 0.5 % of its area is turned.
    bool is_too_much() const;
};

/// Compares the parts of a surface with what they are at other positions.
///
/// Noise makes an area larger, and its removal is no loss. So areas are those of the triangles as
/// they are seen along the mean normal that the triangles around them have afterwards. A folded
/// triangle is seen from behind, and its area counts as negative. Noise hardly changes how far a
/// part spreads. Parts whose size is near `rounding`, that of positions, have lost nothing.
std::vector<PartLoss> losses_of(const Surface& before, const Positions& after, double rounding);

}  // namespace tracked_mcf
