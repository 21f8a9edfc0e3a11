// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

/// Returns the number of connected components of the surface. Without separate sheets, components
/// cannot be told apart and count as one.
inline std::int64_t component_count(const TrackedElements& elements) {
    return elements.levels.front().element_count();
}

/// Returns the connected component of each finest element.
std::vector<std::int32_t> components_of(const TrackedElements& elements);

/// Calls visit(unknown, component) for each unknown of the finest level, once. `component_of` is
/// what components_of() returns.
template <class Visit>
void for_each_unknown(const TrackedElements& elements,
                      const std::vector<std::int32_t>& component_of, const Visit& visit) {
    std::vector<std::uint8_t> visited(static_cast<std::size_t>(elements.finest().unknown_count()));
    for (std::size_t element = 0; element < component_of.size(); ++element) {
        for (const std::int32_t unknown : elements.finest().unknowns[element]) {
            if (visited[unknown] != 0) continue;
            visited[unknown] = 1;
            visit(unknown, component_of[element]);
        }
    }
}

}  // namespace tracked_mcf
