// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/pinches.h"

namespace tracked_mcf {

void constrain_pinched(const TrackedElements& elements, const Supports& supports,
                       const ElementSystems& systems, float pinched_share,
                       std::vector<std::uint8_t>& constrained) {
    std::vector<float> collapsed(supports.mass.size(), 0.0F);
    for (const Collapse& collapse : systems.collapses) {
        const auto& unknowns = elements.finest().unknowns[collapse.element];
        for (int corner = 0; corner < 8; ++corner) {
            collapsed[unknowns[corner]] += collapse.mass[corner];
        }
    }
    for (std::size_t unknown = 0; unknown < collapsed.size(); ++unknown) {
        if (collapsed[unknown] > pinched_share * supports.mass[unknown]) constrained[unknown] = 1;
    }
}

VanishedComponents::VanishedComponents(const TrackedElements& elements)
    : components_(elements.components),
      initial_areas_(static_cast<std::size_t>(components_.count), 0) {
    for (std::size_t element = 0; element < components_.of_element.size(); ++element) {
        for (std::int64_t i = elements.sample_begin[element];
             i < elements.sample_begin[element + 1]; ++i) {
            initial_areas_[components_.of_element[element]] += elements.samples.weight(i);
        }
    }
}

void VanishedComponents::constrain(const ElementSystems& systems, double fraction,
                                   std::vector<std::uint8_t>& constrained) const {
    std::vector<double> areas(initial_areas_.size(), 0);
    for (std::size_t element = 0; element < components_.of_element.size(); ++element) {
        areas[components_.of_element[element]] += systems.areas[element];
    }
    for (std::size_t unknown = 0; unknown < constrained.size(); ++unknown) {
        const std::int32_t component = components_.of_unknown[unknown];
        // Written so that a NaN stays free and propagates.
        if (areas[component] <= fraction * initial_areas_[component]) constrained[unknown] = 1;
    }
}

}  // namespace tracked_mcf
