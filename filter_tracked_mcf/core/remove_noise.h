// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// What happens to the boundary of an open mesh while noise is removed.
enum class NoiseBoundary {
    Locked,  ///< its vertices are held, and keep their noise
    Free,    ///< its vertices move along their normals, so it keeps its outline
    Smooth   ///< its curves are smoothed afterwards, but for their corners
};

/// The parameters of remove_noise(). The defaults need no knowledge of the mesh.
struct NoiseParameters {
    /// Creases are kept where the surface turns by more than this angle, in degrees, at least 0 and
    /// at most 179. 0 keeps no creases.
    double crease_angle = 25;

    /// Standard deviation of the noise along the normals, mesh units. 0 lets the mesh itself choose
    /// how much to smooth.
    double noise = 0;

    /// Greater than 0: how wide what counts as noise is, mesh units: the width of lumps at half
    /// their height, the distance of voxels or slices, half the length of ripples. An edge or less:
    /// single vertices. 0 takes what the mesh itself shows.
    double noise_size = 0;

    /// Greater than 0: waves of this length, mesh units, lose half their amplitude where the
    /// surface is flat and its edges are of mean length. 0 takes what the noise needs.
    double detail_size = 0;

    /// Greater than 0: no vertex moves farther than this, mesh units. 0 is no bound.
    double largest_movement = 0;

    /// Whether vertices move along the normals alone, as rasters and textures need it. Otherwise
    /// they may also slide by twice the noise, which unfolds triangles that noise has folded.
    bool along_normals = false;

    /// Whether also what is as likely detail as noise is removed: lumps and waves a few edges wide,
    /// at the width and height that are found.
    bool lumps = false;

    NoiseBoundary boundary = NoiseBoundary::Free;

    /// None or Displacement: what NoiseReport::quality holds.
    Quality quality = Quality::None;

    /// Number of threads; 0 takes ThreadTeam::default_size(). The result has the same bits for any
    /// number.
    int threads = 0;
};

/// Throws InvalidParameter if a value is outside its range.
void validate(const NoiseParameters& parameters);

/// Why no noise was removed. A rim is smoothed nevertheless if NoiseParameters::boundary asks for
/// it.
enum class NoiseStop {
    None,            ///< it was
    NothingMoves,    ///< all vertices are held
    TooFewVertices,  ///< fewer than 100 may move: too few to measure noise
    TooManyCreases,  ///< creases cross more than half of the area: noise cannot be told from them
    NoNoise,         ///< smoothing takes little of what might be noise, so it is detail
    ModelledPart,    ///< many edges are exactly flat, of very different lengths: there is no noise
    TooMuchLost      ///< smoothing takes more than noise, so it was taken back
};

/// What was removed as noise.
enum class NoiseKind {
    None,      ///< nothing
    White,     ///< single vertices have as much of it everywhere
    Varying,   ///< they have more of it in some places than in others
    Outliers,  ///< some of them have much more than those around them
    Shared,    ///< neighbouring vertices have much the same
    Stairs     ///< as of voxels, slices or whole numbers
};

/// What remove_noise() has measured and done.
///
/// Its detail size is that of the steps that suit the whole surface best; places may have
/// chosen others. See NoiseParameters::detail_size.
struct NoiseReport : SmoothingReport {
    NoiseStop stop = NoiseStop::None;
    NoiseKind kind = NoiseKind::None;
    /// Standard deviation along the normals, mesh units, as measured, whatever the parameters say;
    /// 0 if too few vertices can move.
    double noise = 0;
    double noise_size = 0;  ///< how wide what counts as noise is, see NoiseParameters
    /// Of the edges between vertices that are not flat all around, the share that turns by less
    /// than 0.02°. Noise leaves hardly any.
    double flat_edges = 0;
    /// Deviation of heights in the quietest tenth of places over the median: near 1 if there is as
    /// much noise everywhere, little where there is detail.
    double evenness = kNoNumber;
    std::int64_t outliers = 0;  ///< vertices with so much more noise that they hardly counted
    double crease_share = 0;    ///< share of the area in triangles that a crease crosses
    /// If creases are too many, the angle by which half of the area turns across a triangle,
    /// degrees: more than this are creases that can be told from noise. Else kNoNumber.
    double median_turn = kNoNumber;
    int smoothing_steps = 0;
    int sharpening_steps = 0;   ///< of the bilateral filter after these; 0 if it was worse
    int solver_iterations = 0;  ///< in all steps; each has one or two products with a matrix

    /// The height of stairs, as of voxels, slices or whole numbers, mesh units; 0: there are none.
    double stairs = 0;
    /// The sides of voxels or slices, mesh units: those most nearly along x, y and z; 0: there are
    /// none. They are smoothed if the kind is Stairs; otherwise they may be the shape, and stay.
    double cell_x = 0, cell_y = 0, cell_z = 0;
    /// How many of them the smoothed labels have inside; kNoNumber if that is not defined.
    double voxels = kNoNumber;

    std::int64_t bounded_vertices = 0;  ///< stopped by NoiseParameters::largest_movement
    /// Connected parts that lose more than 3 % of their area or change their volume by as much,
    /// besides their noise, or of whose area more than 0.5 % turns over; and the largest such
    /// shares of a part.
    std::int64_t shrunken_parts = 0;
    /// Those that went back to where they were, because the parameters do not say what the noise
    /// is.
    std::int64_t kept_parts = 0;
    std::int64_t turned_triangles = 0;  ///< folded by the smoothing
    double lost_area = 0, lost_volume = 0;
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
