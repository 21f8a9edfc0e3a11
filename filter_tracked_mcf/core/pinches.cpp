#include "filter_tracked_mcf/core/pinches.h"

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

void freeze_pinched(const TrackedElements& elements, const Supports& supports,
                    const ElementSystems& systems, float pinched_share,
                    std::vector<std::uint8_t>& frozen) {
    if (systems.collapses.empty()) return;
    std::vector<float> collapsed(supports.mass.size(), 0.0F);
    for_each_item(systems.collapses, [&](const Collapse& collapse) {
        const auto& unknowns = elements.finest().unknowns[collapse.element];
        for (int corner = 0; corner < 8; ++corner) {
            collapsed[unknowns[corner]] += collapse.mass[corner];
        }
    });
    serial_for(static_cast<std::int64_t>(collapsed.size()), [&](std::int64_t unknown) {
        if (collapsed[unknown] > pinched_share * supports.mass[unknown]) frozen[unknown] = 1;
    });
}

}  // namespace tracked_mcf
