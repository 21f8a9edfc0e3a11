// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/parts.h"

namespace tracked_mcf {

/// Whether a part is a relief, such as a raster, perhaps with walls and a base.
struct Relief {
    bool is_relief = false;
    double longest_edge = 0;  ///< of triangles in no flat side, in edges
};

/// A relief faces to one side, but for its flat sides. A flat side has a direction in which there
/// are at most two planes. For surfaces with few directions of triangles.
Relief relief_of(const NoisySurface& surface, const PartRange& part);

}  // namespace tracked_mcf
