// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/densities.h"

#include <algorithm>

namespace tracked_mcf {

std::vector<double> triangle_densities(const Domain& domain) {
    if (!domain.has_strengths()) return {};
    std::vector<double> densities;
    densities.reserve(domain.topology().triangles.size());
    for (const auto& [a, b, c] : domain.topology().triangles) {
        const double mean = (domain.strength(a) + domain.strength(b) + domain.strength(c)) / 3;
        const double strength = std::max(mean, kLeastStrength);
        densities.push_back(1 / (strength * strength));
    }
    return densities;
}

}  // namespace tracked_mcf
