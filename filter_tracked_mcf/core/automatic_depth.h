#pragma once

#include <functional>

#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Clips the mesh to `cube` (of depth 0) at the depth, 1 to kMaximumDepth, whose number of unknowns
/// is nearest `vertices`, the number of different vertices that triangles use. The numbers are
/// counted, at the depths that can decide, given that each has at least twice as many as the one
/// before. The depth is 1 if all triangles are degenerate. `before_clipping` is called with every
/// depth that is about to be clipped at, and may throw. Throws what clip_to_grid does.
ClippedSurface clip_at_automatic_depth(
    const TriangleMesh& mesh, const Grid& cube, std::int64_t vertices,
    const std::function<void(int)>& before_clipping = [](int) {});

/// That depth in the mesh's own enclosing grid, coincident vertices counting as one.
int automatic_depth(const TriangleMesh& mesh);

}  // namespace tracked_mcf
