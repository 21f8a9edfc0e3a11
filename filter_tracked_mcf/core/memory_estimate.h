#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/grid.h"

namespace tracked_mcf {

/// The sums over a surface from which follows how many pieces any grid cuts it into.
struct SurfaceSize {
    double vertices = 0;   ///< of the whole mesh
    double triangles = 0;  ///< that flow
    double edges = 0;      ///< of those
    double extents = 0;    ///< the sides of every triangle's bounding box, mesh units
    double shadows = 0;    ///< area of every triangle's projections along the axes, mesh units²
    double rim = 0;        ///< the sides of every boundary edge's bounding box, mesh units
    /// Vertices - edges + triangles, coincident vertices being one: 2 for every closed part without
    /// handles, 1 for every disk. Not less than 0.
    double characteristic = 0;
    bool is_part = false;  ///< whether there are triangles that do not flow
};

SurfaceSize size_of(const Domain& domain);

/// How much of everything a flow is expected to have: the mean over where the planes of the grid
/// may be. Exact in that sense for fragments and samples; for elements and unknowns if the surface
/// in every cell and support is a disk.
struct ExpectedCounts {
    double fragments = 0;
    double samples = 0;
    double elements = 0;      ///< of the finest level
    double unknowns = 0;      ///< of the finest level
    double all_elements = 0;  ///< of all levels
    double all_unknowns = 0;  ///< of all levels
    double all_entries = 0;   ///< of all levels' matrices, which only Solver::OneWCycle makes
    double coarsest_elements = 0;
};

ExpectedCounts expected_counts(const SurfaceSize& size, const Grid& grid,
                               const FlowParameters& parameters);

/// Bytes that evolve() is expected to need at once, at most, besides what the mesh takes.
double estimate_flow_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters);

/// Of these, what clipping to a grid, and counting its unknowns, needs.
double estimate_clip_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters);

/// What a Domain of a surface of this size holds.
double estimate_domain_bytes(const SurfaceSize& size);

}  // namespace tracked_mcf
