// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// Holds the vertices of a surface that triangles of the mesh outside it have, too. `selection` has
/// the triangles that became the surface; it is empty if all did.
void hold_seam(Surface& surface, const TriangleMesh& mesh, const Selection& selection);

/// Sets which vertices and sides are held, see surface_of(), and how many edges are on the rim of
/// the mesh.
///
/// A sliver, a triangle without a reliable normal, passes on what holds one of its sides: the
/// sides lie on each other. Where it has a neighbour with an area, its own sides do not count.
void hold_vertices(Surface& surface, const TriangleMesh& mesh, const Selection& selection,
                   BoundaryCondition boundary);

}  // namespace tracked_mcf
