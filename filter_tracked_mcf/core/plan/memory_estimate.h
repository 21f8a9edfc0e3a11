// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/cells/cubature.h"
#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/domain.h"

namespace tracked_mcf {

/// Sums over a surface that give the expected number of its fragments, elements and unknowns on any
/// grid. Lengths are in mesh units.
struct SurfaceSize {
    double vertices = 0;   ///< of the whole mesh
    double triangles = 0;  ///< of the surface
    double extents = 0;    ///< total length of the sides of the triangles' bounding boxes
    double shadows = 0;    ///< total area of the triangles' projections along the three axes
    double rim = 0;        ///< total length of the sides of the boundary edges' bounding boxes
    /// Mean number of copies of each triangle; at least 1. The copies have the same edges, so they
    /// belong to the same elements.
    double copies = 1;
    /// Euler characteristic, coincident vertices and copies of triangles counting as one. It is 2
    /// for a closed component and 1 for a disk, less 2 for each handle and 1 for each hole.
    double characteristic = 0;
};

/// Returns the sums over the domain's surface.
SurfaceSize size_of(const Domain& domain);

/// The expected numbers of items of a flow: means over all positions of the grid's planes. They are
/// exact means for fragments, for samples unless small fragments have three points as a whole, and
/// for elements and unknowns if the surface in every cell and support is a disk.
struct ExpectedCounts {
    double fragments = 0;
    double samples = 0;
    double elements = 0;      ///< of the finest level
    double unknowns = 0;      ///< of the finest level
    double all_elements = 0;  ///< of all levels
    double all_unknowns = 0;  ///< of all levels
};

ExpectedCounts expected_counts(const SurfaceSize& size, const Grid& grid,
                               const Discretisation& discretisation);

/// Returns the expected peak of the memory, in bytes, that evolve() takes besides the mesh.
double estimate_flow_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters);

/// Returns the expected peak of the memory, in bytes, up to the end of the clipping.
double estimate_clip_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters);

}  // namespace tracked_mcf
