// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/plan/automatic_depth.h"
#include "filter_tracked_mcf/core/plan/memory_check.h"
#include "filter_tracked_mcf/core/plan/memory_estimate.h"

namespace tracked_mcf {

/// Clips the domain's surface to the grid and builds its elements. Throws what clip_to_grid and
/// build_tracked_elements throw.
inline TrackedElements build_tracked_elements(const Domain& domain, const Grid& grid,
                                              Cubature cubature, bool separate_sheets = true) {
    return build_tracked_elements(domain, clip_to_grid(domain.surface(), grid),
                                  {cubature, cubature == Cubature::ThreePoints, separate_sheets});
}

/// Builds the elements of a whole mesh with its boundary constrained.
inline TrackedElements build_tracked_elements(const TriangleMesh& mesh, const Grid& grid,
                                              Cubature cubature, bool separate_sheets = true) {
    return build_tracked_elements(Domain(mesh, BoundaryCondition::Locked), grid, cubature,
                                  separate_sheets);
}

/// Returns the automatic depth of a whole mesh, for a detail that needs `least_depth`, with so much
/// memory, or as much as is needed.
inline int automatic_depth(const TriangleMesh& mesh, int least_depth = 0,
                           std::int64_t available_memory = 0) {
    const Domain domain(mesh, BoundaryCondition::Free);
    const Grid cube = enclosing_grid(mesh, 0);
    const SurfaceSize size = size_of(domain);
    return clip_at_automatic_depth(domain, size, cube, least_depth,
                                   MemoryCheck(size, cube, {}, available_memory))
        .grid.depth;
}

}  // namespace tracked_mcf
