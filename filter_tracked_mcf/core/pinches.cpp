#include "filter_tracked_mcf/core/pinches.h"

namespace tracked_mcf {

namespace {

constexpr float kPinchedShare = 0.5F;

/// ∫ B_I² over the initial surface, of every unknown of the finest level.
std::vector<float> initial_mass(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    ElementSystems initial;
    assemble_elements(elements, Coefficients::Zero(finest.unknown_count(), 3), {1, 0}, initial);
    std::vector<float> mass(static_cast<std::size_t>(finest.unknown_count()), 0.0F);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            mass[finest.unknowns[element][corner]] +=
                initial.matrices[element].entry[corner][corner];
        }
    }
    return mass;
}

}  // namespace

void Pinches::freeze(const ElementSystems& systems, std::vector<std::uint8_t>& frozen) {
    if (systems.collapses.empty()) return;
    if (initial_mass_.empty()) initial_mass_ = initial_mass(elements_);
    std::vector<float> collapsed(initial_mass_.size(), 0.0F);
    for (const Collapse& collapse : systems.collapses) {
        const auto& unknowns = elements_.finest().unknowns[collapse.element];
        for (int corner = 0; corner < 8; ++corner) {
            collapsed[unknowns[corner]] += collapse.mass[corner];
        }
    }
    for (std::size_t unknown = 0; unknown < collapsed.size(); ++unknown) {
        if (collapsed[unknown] > kPinchedShare * initial_mass_[unknown]) frozen[unknown] = 1;
    }
}

}  // namespace tracked_mcf
