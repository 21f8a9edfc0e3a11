// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/cross_validation.h"

namespace tracked_mcf {

/// Stairs that a surface consists of, in edges.
struct Stairs {
    double height = 0;         ///< 0: there are none
    bool are_certain = false;  ///< otherwise they may be those of a model with few faces
};

/// Returns the stairs of a surface.
///
/// Stairs have few directions of triangles, at least three parallel planes in one of these, and
/// planes that are nearer to each other than an edge. They are certain if three directions have
/// many planes at equal distances, and if there are no long edges, as of voxels, slices or whole
/// numbers.
Stairs stairs_of(const NoisySurface& surface);

/// What a surface without noise from vertex to vertex has instead. Lengths are in edges.
struct Unevenness {
    double stairs = 0;  ///< height of stairs; 0: none
    double width = 0;   ///< of lumps or waves that may be noise; 0: none were found
    double height = 0;  ///< their standard deviation
};

/// Looks for stairs, and for lumps and waves on a sample. Lumps cannot be told from detail for
/// certain, so this is for a message, not for moving vertices.
Unevenness unevenness_of(const NoisySurface& surface, const NoiseRequest& request);

}  // namespace tracked_mcf
