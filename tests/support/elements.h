// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/cells/fragments.h"
#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"

namespace tracked_mcf {

/// Returns the grid around a mesh.
inline Grid enclosing_grid(const TriangleMesh& mesh, int depth) {
    return enclosing_grid(bounding_box(mesh), depth);
}

/// Clips a mesh to the grid and builds its elements. Throws what clip_to_grid and
/// build_tracked_elements throw.
inline TrackedElements build_tracked_elements(
    const TriangleMesh& mesh, const Grid& grid, Cubature cubature,
    BoundaryCondition boundary = BoundaryCondition::Locked) {
    const Surface surface = surface_of(mesh, {}, boundary);
    const Positions positions = surface.in_mesh_units(mesh);
    return build_tracked_elements(surface, clip_to_grid({positions, surface.stars.triangles}, grid),
                                  cubature);
}

/// Returns the coefficients of the identity, Σ (i, j, k) B_ijk(p) = p (section 5.3): the
/// coefficient of each unknown is its corner.
inline Coefficients identity_coefficients(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    Coefficients coefficients(finest.unknown_count(), 3);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        const Cell cell = cell_at(finest.cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            coefficients.row(finest.unknowns[element][corner]) =
                corner_of(cell, corner).cast<double>().transpose();
        }
    }
    return coefficients;
}

}  // namespace tracked_mcf
