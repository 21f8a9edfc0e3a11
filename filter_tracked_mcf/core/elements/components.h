// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

inline std::int64_t component_count(const TrackedElements& elements) {
    return elements.components.count;
}

inline std::vector<std::int32_t> components_of(const TrackedElements& elements) {
    return elements.components.of_element;
}

/// Calls visit(unknown, component) for each unknown of the finest level.
template <class Visit>
void for_each_unknown(const TrackedElements& elements,
                      const std::vector<std::int32_t>& /*component_of*/, const Visit& visit) {
    const std::vector<std::int32_t>& of_unknown = elements.components.of_unknown;
    for (std::size_t unknown = 0; unknown < of_unknown.size(); ++unknown) {
        visit(static_cast<std::int32_t>(unknown), of_unknown[unknown]);
    }
}

}  // namespace tracked_mcf
