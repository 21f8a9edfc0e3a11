// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/cross_validation.h"

namespace tracked_mcf {

/// What a surface without noise from vertex to vertex has instead. Lengths are in edges.
struct Unevenness {
    double stairs = 0;  ///< height of the stairs of voxels, slices or whole numbers; 0: none
    double width = 0;   ///< of lumps or waves that may be noise; 0: none were found
    double height = 0;  ///< their standard deviation
};

/// Returns the height of the stairs that a surface consists of, 0 if it has none.
///
/// Stairs have few directions of triangles, at least three parallel planes in one of these, and
/// planes that are nearer to each other than an edge.
double height_of_stairs(const NoisySurface& surface);

/// Looks for stairs, and for lumps and waves on a sample. Lumps cannot be told from detail for
/// certain, so this is for a message, not for moving vertices.
Unevenness unevenness_of(const NoisySurface& surface, const NoiseWishes& wishes);

}  // namespace tracked_mcf
