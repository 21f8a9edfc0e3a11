#include "filter_tracked_mcf/core/supports.h"

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

constexpr float kNegligible = 1e-8F;

/// What one element adds to the functions of its cell.
struct Share {
    float mass[8] = {};
    float area = 0;
};

Share share_of(const TrackedElements& elements, std::int64_t element) {
    Share share;
    for (std::int64_t i = elements.sample_begin[element]; i < elements.sample_begin[element + 1];
         ++i) {
        const float weight = elements.samples.weight(i);
        const CornerValues values = bspline_values(elements.samples.local(i));
        for (int corner = 0; corner < 8; ++corner) {
            share.mass[corner] += weight * static_cast<float>(values[corner] * values[corner]);
        }
        share.area += weight;
    }
    return share;
}

}  // namespace

Supports measure_supports(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    std::vector<Share> shares;
    resize(shares, finest.element_count());
    parallel_for_blocks(finest.element_count(), [&](std::int64_t begin, std::int64_t end) {
        Pacer pacer;
        for (std::int64_t element = begin; element < end; ++element) {
            shares[element] = share_of(elements, element);
            pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
        }
    });
    const auto count = static_cast<std::size_t>(finest.unknown_count());
    Supports supports{std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F)};
    serial_for(finest.element_count(), [&](std::int64_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            const std::int32_t unknown = finest.unknowns[element][corner];
            supports.mass[unknown] += shares[element].mass[corner];
            supports.area[unknown] += shares[element].area;
        }
    });
    return supports;
}

void freeze_negligible(const Supports& supports, std::vector<std::uint8_t>& frozen) {
    serial_for(static_cast<std::int64_t>(frozen.size()), [&](std::int64_t unknown) {
        if (supports.mass[unknown] <= kNegligible * supports.area[unknown]) frozen[unknown] = 1;
    });
}

}  // namespace tracked_mcf
