// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/densities.h"

#include <algorithm>

namespace tracked_mcf {

std::vector<float> triangle_densities(const Surface& surface) {
    const std::vector<double>& strengths = surface.strengths;
    if (strengths.empty()) return {};
    std::vector<float> densities;
    densities.reserve(surface.stars.triangles.size());
    for (const auto& [a, b, c] : surface.stars.triangles) {
        const double mean = (strengths[a] + strengths[b] + strengths[c]) / 3;
        const double strength = std::max(mean, kLeastStrength);
        densities.push_back(static_cast<float>(1 / (strength * strength)));
    }
    return densities;
}

}  // namespace tracked_mcf
