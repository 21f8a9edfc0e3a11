// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns which noise a candidate has taken from a surface. `heights` are how far it has moved
/// each vertex along its normal, in edges; only those of vertices that count decide.
NoiseKind kind_of_noise(const Stars& stars, const std::vector<float>& heights,
                        const std::vector<std::uint8_t>& counts);

/// Returns how much each vertex should keep its position, relative to others, where noise varies.
/// This falls with the noise around the vertex. `heights` are how far a trial has moved each vertex
/// along its normal: a short step that keeps no creases, as large noise passes for them.
std::vector<float> fidelities_to_noise(const Stars& stars, const std::vector<float>& heights);

/// Returns how much each vertex should keep its position when the surface is smoothed again,
/// relative to others, by how far the last smoothing has moved it along its normal: the weight of
/// Geman and McClure,
/// (1 + (h / c)²)⁻², where c is three deviations of the heights around the vertex, so that detail,
/// which moves whole neighbourhoods, does not count as outliers.
std::vector<float> fidelities_to_outliers(const Stars& stars, const std::vector<float>& heights);

/// Returns whether a vertex with this fidelity to outliers is one.
inline bool is_outlier(float fidelity) {
    return fidelity < 0.1F;
}

}  // namespace tracked_mcf
