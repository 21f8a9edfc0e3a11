#include "filter_tracked_mcf/core/pinches.h"

namespace tracked_mcf {

void freeze_pinched(const TrackedElements& elements, const Supports& supports,
                    const ElementSystems& systems, float pinched_share,
                    std::vector<std::uint8_t>& frozen) {
    if (systems.collapses.empty()) return;
    std::vector<float> collapsed(supports.mass.size(), 0.0F);
    for (const Collapse& collapse : systems.collapses) {
        const auto& unknowns = elements.finest().unknowns[collapse.element];
        for (int corner = 0; corner < 8; ++corner) {
            collapsed[unknowns[corner]] += collapse.mass[corner];
        }
    }
    for (std::size_t unknown = 0; unknown < collapsed.size(); ++unknown) {
        if (collapsed[unknown] > pinched_share * supports.mass[unknown]) frozen[unknown] = 1;
    }
}

}  // namespace tracked_mcf
