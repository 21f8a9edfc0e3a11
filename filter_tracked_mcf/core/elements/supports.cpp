// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/supports.h"

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

constexpr float kNegligible = 1e-8F;

/// The integrals of the squares of a cell's functions over one element, and its area.
struct ElementSupport {
    float mass[8] = {};
    float area = 0;
};

ElementSupport support_of(const TrackedElements& elements, std::int64_t element) {
    ElementSupport support;
    for (std::int64_t i = elements.sample_begin[element]; i < elements.sample_begin[element + 1];
         ++i) {
        const float weight = elements.samples.weight(i);
        const CornerValues values = bspline_values(elements.samples.local(i));
        for (int corner = 0; corner < 8; ++corner) {
            support.mass[corner] += weight * static_cast<float>(values[corner] * values[corner]);
        }
        support.area += weight;
    }
    return support;
}

}  // namespace

Supports measure_supports(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    std::vector<ElementSupport> of_elements(finest.cells.size());
    parallel_for_chunks(finest.element_count(), [&](std::int64_t begin, std::int64_t end) {
        Pacer pacer;
        for (std::int64_t element = begin; element < end; ++element) {
            of_elements[element] = support_of(elements, element);
            pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
        }
    });
    const auto count = static_cast<std::size_t>(finest.unknown_count());
    Supports supports{std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F)};
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            const std::int32_t unknown = finest.unknowns[element][corner];
            supports.mass[unknown] += of_elements[element].mass[corner];
            supports.area[unknown] += of_elements[element].area;
        }
    }
    return supports;
}

void constrain_negligible(const Supports& supports, std::vector<std::uint8_t>& constrained) {
    for (std::size_t unknown = 0; unknown < constrained.size(); ++unknown) {
        if (supports.mass[unknown] <= kNegligible * supports.area[unknown])
            constrained[unknown] = 1;
    }
}

}  // namespace tracked_mcf
