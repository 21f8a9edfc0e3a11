// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/components.h"

#include <numeric>
#include <utility>

namespace tracked_mcf {

std::vector<std::int32_t> components_of(const TrackedElements& elements) {
    // The coarsest level has one element for each connected component.
    std::vector<std::int32_t> component_of(
        static_cast<std::size_t>(elements.levels.front().element_count()));
    std::iota(component_of.begin(), component_of.end(), 0);
    for (std::size_t level = 1; level < elements.levels.size(); ++level) {
        std::vector<std::int32_t> finer;
        finer.reserve(elements.levels[level].parents.size());
        for (const std::int32_t parent : elements.levels[level].parents) {
            finer.push_back(component_of[parent]);
        }
        component_of = std::move(finer);
    }
    return component_of;
}

}  // namespace tracked_mcf
