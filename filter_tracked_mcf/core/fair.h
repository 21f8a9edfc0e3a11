// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// What a faired patch shares with the surface around it, along the seam.
enum class Continuity {
    Position,  ///< C0: the membrane
    Tangent,   ///< C1: the thin plate
    Curvature  ///< C2
};

/// The parameters of fair().
struct FairParameters {
    Continuity continuity = Continuity::Tangent;

    /// None or Displacement: what FairReport::quality holds.
    Quality quality = Quality::None;

    /// Number of threads; 0 takes ThreadTeam::default_size(). The result has the same bits for any
    /// number.
    int threads = 0;
};

/// Throws InvalidParameter if a value is outside its range.
void validate(const FairParameters& parameters);

/// What fair() has measured and done. Its vertices are those that may move, its triangles those
/// that are selected.
struct FairReport : FilterReport {
    std::int64_t patches = 0;  ///< 0: the selection has no inner vertices, so nothing has moved
    /// Of these, patches that have less continuity than was asked for: more would have changed them
    /// by more than the continuity before, or taken them farther than `height` 1 from the membrane.
    std::int64_t flatter_patches = 0;
    std::int64_t rough_patches = 0;  ///< that chance may have raised, as their surroundings turn

    /// RMS of the mean curvature around the seams and in the faired patches, in 1 / mesh units. If
    /// the first is much larger, the surroundings are too rough for the size of the hole to tell
    /// its tangent.
    double seam_curvature = 0, patch_curvature = 0;
    /// Largest distance from the membrane, relative to the size of the hole: the diameter of a
    /// sphere around its seam.
    double height = 0;
    int passes = 0;  ///< solves in a new metric, of the patch that took most
};

/// Makes the selected faces of `mesh` continue the surface around them, such as those that fill a
/// hole.
///
/// The inner vertices of the selection move: those of which all faces are selected, and which are
/// not on the rim of an open mesh. All other vertices keep their bits, so a selection at a rim
/// keeps the rim. The result does not depend on the orientation of the faces.
///
/// With mass M and stiffness L of linear elements, the positions x solve L x = 0 (Position),
/// L M⁻¹ L x = 0 (Tangent) or L M⁻¹ L M⁻¹ L x = 0 (Curvature) at the inner vertices, where M and L
/// are those of the result. A patch takes less continuity where its surroundings do not tell more,
/// see FairReport::flatter_patches. So it is never farther from the membrane than the hole is wide.
///
/// Positions are written at the very end, after the last call of `progress` has returned true.
/// Throws InvalidMesh if nothing holds a patch, also InvalidParameter, NotEnoughMemory or Cancelled
/// (errors.h). Then the mesh is unchanged.
FairReport fair(TriangleMesh& mesh, const Selection& selection, const FairParameters& parameters,
                const Progress& progress = {});

}  // namespace tracked_mcf
