// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// How a filter has changed the triangles that it moves.
struct ChangeReport {
    double rms_displacement = 0;             ///< of the vertices that the report counts, mesh units
    double largest_displacement = 0;         ///< of one of them, mesh units
    double area_before = 0, area_after = 0;  ///< of the triangles, mesh units²
    /// Volume between the initial and the final surface, mesh units³. It is positive where the
    /// surface has moved along its normals. Of a closed surface, it is the change of the enclosed
    /// volume. Means nothing unless the triangles are oriented consistently.
    double volume_change = 0;
    /// Enclosed, mesh units³; 0 unless all of the mesh moves and bounds a volume.
    double volume_before = 0;
};

}  // namespace tracked_mcf
