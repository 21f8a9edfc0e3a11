// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// The directions of the copies that a triangle had.
enum class Directions : std::uint8_t {
    One,     ///< all had the same
    Uneven,  ///< most had one
    Even     ///< as many had the other one
};

/// Orients the triangles of a surface alike where they share an edge with just one other: as most
/// of the area is; where no direction has more, so that the enclosed volume is positive. A surface
/// with one side gets a seam. `directions` are those of the triangles; none if all are One.
/// Triangles with Even directions do not count as area.
void orient_alike(Surface& surface, const std::vector<Directions>& directions);

}  // namespace tracked_mcf
