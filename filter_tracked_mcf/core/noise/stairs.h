// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// Stairs that a relief consists of, in edges.
struct Stairs {
    double height = 0;         ///< 0: there are none
    bool are_certain = false;  ///< otherwise they may be those of a model with few faces
};

/// Returns the stairs of a relief, such as a raster of heights in whole numbers. It may have walls
/// and a base. Labels have other stairs (labels.h).
///
/// Stairs have few directions of triangles, at least three parallel planes in one of these, and
/// planes that are nearer to each other than an edge. All triangles face to one side, but for flat
/// sides. They are certain if three directions have many planes at equal distances, and if there
/// are no long edges but in flat sides.
Stairs stairs_of(const NoisySurface& surface);

}  // namespace tracked_mcf
