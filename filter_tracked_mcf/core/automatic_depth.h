#pragma once

#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The depth of `cube` (of depth 0), 1 to kMaximumDepth, whose number of unknowns is nearest the
/// number of the mesh's referenced vertices, coincident ones counting as one. The numbers are
/// counted, at the depths that can decide, given that each has at least twice as many as the one
/// before. 1 if all triangles are degenerate.
int automatic_depth(const TriangleMesh& mesh, const Grid& cube);

/// The same in the mesh's own enclosing grid.
int automatic_depth(const TriangleMesh& mesh);

}  // namespace tracked_mcf
