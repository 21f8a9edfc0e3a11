// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/change_report.h"
#include "filter_tracked_mcf/core/crack_report.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/noise_parameters.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Why no noise was removed. A rim is smoothed nevertheless if NoiseParameters::boundary asks for
/// it.
enum class NoiseStop {
    None,            ///< it was
    NothingMoves,    ///< all vertices are constrained
    TooFewVertices,  ///< fewer than 100 may move: too few to measure noise
    TooManyCreases,  ///< creases cross more than half of the area: noise cannot be told from them
    NoNoise          ///< treatments take little of what might be noise, so it is detail
};

/// What remove_noise() has measured and done.
struct NoiseReport : ChangeReport {
    std::int64_t vertices = 0;              ///< of the smoothed triangles, coincident ones once
    std::int64_t triangles = 0;             ///< that were smoothed
    std::int64_t degenerate_triangles = 0;  ///< of these, with zero area
    std::int64_t boundary_edges = 0;
    std::int64_t constrained_vertices = 0;  ///< of the vertices above that keep their bits
    CrackReport cracks;

    NoiseStop stop = NoiseStop::None;
    /// Standard deviation along the normals, mesh units, as measured, whatever the parameters say;
    /// 0 if too few vertices can move.
    double noise = 0;
    double noise_size = 0;      ///< how wide what counts as noise is, see NoiseParameters
    std::int64_t outliers = 0;  ///< vertices with so much more noise that they hardly counted
    double crease_share = 0;    ///< share of the area in triangles that a crease crosses
    /// If creases are too many, the angle by which half of the area turns across a triangle,
    /// degrees: more than this are creases that can be told from noise.
    double median_turn = 0;
    /// Of the treatment that suits the whole surface best; places may have chosen others. See
    /// NoiseParameters::detail_size; 0 if there was nothing to do.
    double detail_size = 0;
    int steps = 0;
    int sharpenings = 0;  ///< iterations of the bilateral filter after the steps; 0 if it was worse
    int iterations = 0;   ///< of conjugate gradients, all steps

    /// The height of stairs, as of voxels, slices or whole numbers, mesh units; 0: there are none.
    /// Where there is no noise from vertex to vertex, also the width and the standard deviation of
    /// lumps or waves that may be noise nevertheless.
    double stairs = 0, lump_width = 0, lump_height = 0;

    std::int64_t bounded_vertices = 0;  ///< stopped by NoiseParameters::largest_movement
    /// Connected parts that have lost more than 3 % of their area or changed their volume by as
    /// much, not counting the area that noise adds; and the largest such shares of a part.
    std::int64_t shrunken_parts = 0;
    double lost_area = 0, lost_volume = 0;
    bool oriented_consistently = true;
    /// Per vertex of the mesh: how far it has moved along the normal of the result, mesh units.
    /// Empty unless NoiseParameters::quality asks for it.
    std::vector<double> quality;
    double seconds = 0;
    std::int64_t peak_memory_bytes = 0;  ///< of the process
};

/// Removes noise from `mesh`, or only from its selected triangles, and keeps creases. Noise is what
/// single vertices do independently of their neighbours. It may be larger in some places than in
/// others, and single vertices may have much more of it.
///
/// Each vertex smooths as much as Inputs::strength says. Positions are written at the very
/// end, after the last call of `progress` has returned true. Vertices that do not move keep their
/// bits: those of the locked boundary, of unselected triangles, with strength 0, and in no
/// triangle.
///
/// Throws InvalidMesh, InvalidParameter, NotEnoughMemory or Cancelled (errors.h) and leaves the
/// mesh unchanged.
NoiseReport remove_noise(TriangleMesh& mesh, const Inputs& inputs,
                         const NoiseParameters& parameters, const Progress& progress = {});

}  // namespace tracked_mcf
