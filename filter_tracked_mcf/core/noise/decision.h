// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/noise/cross_validation.h"
#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/noise/spikes.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// What noise a surface has, and how to remove it. Lengths are in edges.
struct Decision {
    NoiseStop stop = NoiseStop::None;  ///< why nothing but spikes is removed
    NoiseKind kind = NoiseKind::White;
    NoiseRequest request;  ///< of the user, or of what the surface shows
    Choice choice;         ///< what suits the request
    Choice usual;  ///< with the usual creases, and without request; empty if it cannot be measured
    bool is_rare = false;       ///< whether most places have no noise
    std::vector<Spike> spikes;  ///< each with the place of its tip

    /// Returns whether the mesh itself says what its noise is, from vertex to vertex.
    bool is_measured() const {
        return request.noise == 0 && request.detail_size == 0 && !request.is_certain;
    }
};

/// Decides what noise a surface has, and reports what it has seen. `edge` is the length of an edge
/// in mesh units, and `rounding` the error of a position, in edges.
///
/// If the user does not say what the noise is, changes the surface: holds places that are exactly
/// flat, and puts spikes into the planes of their neighbours.
Decision decide(NoisySurface& surface, double edge, double rounding,
                const NoiseParameters& parameters, NoiseReport& report);

/// Returns the sample on which candidates are tried.
Sample sample_for_candidates(const NoisySurface& surface,
                             const std::vector<float>& fidelities = {});

/// Returns a larger sample, of many places.
Sample sample_of_many_places(const NoisySurface& surface,
                             const std::vector<float>& fidelities = {});

}  // namespace tracked_mcf
