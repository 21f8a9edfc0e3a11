// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace tracked_mcf {

/// A number of a report that means nothing.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Rims that run beside each other with hardly a gap. Files have them where one point was written
/// twice, with different rounding.
struct CrackReport {
    std::int64_t joined_vertices = 0;  ///< that count as one with another, as coincident ones do
    std::int64_t open_pairs = 0;       ///< pairs of vertices that are farther apart: they stay two
    double open_width = 0;             ///< the largest distance of such a pair, mesh units
};

/// What every filter reports of the triangles that it moves. Coincident vertices count once.
/// presentation/report_table.h says how hosts call these numbers.
struct FilterReport {
    std::int64_t vertices = 0;
    std::int64_t triangles = 0;
    std::int64_t degenerate_triangles = 0;  ///< of these, without an area: they have no influence
    std::int64_t copied_triangles = 0;      ///< of these, with the vertices of another: count once
    std::int64_t double_sided_parts = 0;    ///< with copies both ways of most of their area
    CrackReport cracks;

    double rms_displacement = 0;             ///< of the vertices, mesh units
    double largest_displacement = 0;         ///< of one of them, mesh units
    double area_before = 0, area_after = 0;  ///< of the triangles, mesh units²
    /// Enclosed, mesh units³; kNoNumber unless all of the mesh moves and bounds a volume.
    double volume_before = kNoNumber;
    /// Volume between the initial and the final surface, mesh units³. It is positive where the
    /// surface has moved along its normals. Of a closed surface, it is the change of the enclosed
    /// volume. kNoNumber if the triangles cannot be oriented alike.
    double volume_change = kNoNumber;

    /// One number per vertex of the mesh, see Quality; 0 at vertices of other triangles. Empty
    /// unless a parameter asks for it.
    std::vector<double> quality;
    double seconds = 0;
    std::int64_t peak_memory_bytes = 0;  ///< of the whole process; 0 if unknown
};

/// What filters that smooth a surface, rather than patches of it, report, too.
struct SmoothingReport : FilterReport {
    std::int64_t boundary_edges = 0;
    std::int64_t held_vertices = 0;  ///< of the vertices, those that keep their bits
    /// Bumps of this size became half as high, mesh units; 0 if there was nothing to do.
    double detail_size = 0;
};

}  // namespace tracked_mcf
