// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// What happens to the boundary of an open mesh while noise is removed.
enum class NoiseBoundary {
    Locked,  ///< its vertices keep their bits, and their noise
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

    /// Greater than 0: how wide what counts as noise is, mesh units: the distance of voxels or
    /// slices, half the length of ripples, half the width of lumps. A little too much is better
    /// than too little. An edge or less: single vertices. 0 is single vertices, too, unless the
    /// mesh consists of stairs, as of voxels.
    double noise_size = 0;

    /// Greater than 0: waves of this length, mesh units, lose half their amplitude where the
    /// surface is flat and its edges are of mean length. 0 takes what the noise needs.
    double detail_size = 0;

    /// Greater than 0: no vertex moves farther than this, mesh units. 0 is no bound.
    double largest_movement = 0;

    /// Whether vertices move along the normals alone, as rasters and textures need it. Otherwise
    /// they may also slide by twice the noise, which unfolds triangles that noise has folded.
    bool along_normals = false;

    NoiseBoundary boundary = NoiseBoundary::Free;

    /// None or Displacement: what NoiseReport::quality holds.
    Quality quality = Quality::None;

    /// Number of threads; 0 takes ThreadTeam::default_size(). The result has the same bits for any
    /// number.
    int threads = 0;
};

/// Throws InvalidParameter if a value is outside its range.
void validate(const NoiseParameters& parameters);

}  // namespace tracked_mcf
