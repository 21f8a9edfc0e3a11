// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// What three short steps show of the heights of a surface's vertices. Each step has four times the
/// size of the one before, so it takes waves that are twice as long. In windows of about 150
/// vertices, a step shows the deviation of white noise of which it would take as much. Lengths are
/// in edges.
struct Evidence {
    /// In the quietest quarter of the windows: what the second step shows.
    double height = 0;
    /// There: from the first step to the second; 1 with white noise.
    double rise = 0;
    /// There: from the second step to the third; near 1 once the steps take all of the noise.
    double growth = 0;
    /// What the second step shows in the quietest tenth, over its median. Noise leaves no quiet
    /// places.
    double evenness = 0;
    /// Of what the second step takes, relative to its deviation in the window: 0 and about 2.8 with
    /// noise. Patterns have other values.
    double skewness = 0, kurtosis = 0;
    /// Share of the vertices that the first step moves by less than a quarter of the deviation in
    /// their window, over that of normally distributed heights: 1 with noise, which leaves no more
    /// vertices still, and 1.5 to 3.3 with letters and pits.
    double stillness = 0;
    /// Whether there is white noise in some places, and far less of anything in most others: all
    /// three steps show the same there.
    bool is_white_in_places = false;
};

/// Looks at a sample. `crease` is the difference of unit normals across the least crease, 0 without
/// creases, and `rounding` the error of a position.
Evidence evidence_of(const Sample& sample, double crease, double rounding);

/// Noise that neighbouring vertices share. Lengths are in edges.
struct SharedNoise {
    double width = 0;   ///< of a lump at half its height; 0: there is no such noise
    double height = 0;  ///< standard deviation
};

/// Returns the noise that neighbouring vertices share: the same everywhere, and with hardly more of
/// it in longer waves. Detail is higher in some places than in others, and the higher the longer
/// its waves are. With `beside_white`, single vertices show noise, too, and what rises like this
/// noise beside detail is none.
SharedNoise shared_noise_of(const Evidence& evidence, bool beside_white);

/// Returns whether what single vertices show, as this kind of noise, is a pattern.
bool is_pattern(const Evidence& evidence, NoiseKind kind);

/// Returns the lumps of a surface as if they were noise.
SharedNoise lumps_of(const Evidence& evidence);

}  // namespace tracked_mcf
