// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/supports.h"
#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"

namespace tracked_mcf {

/// A function has pinched once more than this fraction of it has collapsed. Collapsed samples
/// contribute nothing to the equations, so a free function moves its collapsed part anywhere at no
/// cost, and the further the better the equations are solved. Long flows of scans decide the
/// values: with a larger fraction the converged solver throws vertices far away, with a smaller one
/// stubs stay rough.
inline constexpr float kPinchedShareConverged = 0.05F;
inline constexpr float kPinchedShareOneWCycle = 0.5F;

/// Constrains the unknowns that have pinched (section 5.1).
///
/// Sets in `constrained` (one flag per unknown of the finest level) each unknown of whose function
/// more than `pinched_share`, measured by ∫ B_I² over the initial surface, lies where samples have
/// collapsed under the metric of `systems`. The unknown keeps its value from then on.
void constrain_pinched(const TrackedElements& elements, const Supports& supports,
                       const ElementSystems& systems, float pinched_share,
                       std::vector<std::uint8_t>& constrained);

/// Finds connected components of the surface that have vanished while others have not. Only a
/// conformalized flow needs this, since its samples never collapse: beside its stiffness, the mass
/// of a vanished component is lost to rounding, and with it the component's location.
class VanishedComponents {
public:
    /// Measures the initial area of each component. `elements` must outlive this.
    explicit VanishedComponents(const TrackedElements& elements);

    /// Sets in `constrained` (one flag per unknown of the finest level) the unknowns of components
    /// whose area, under the metric of `systems`, is at most `fraction` of their initial area.
    void constrain(const ElementSystems& systems, double fraction,
                   std::vector<std::uint8_t>& constrained) const;

private:
    const Components& components_;
    std::vector<double> initial_areas_;  ///< one per component, grid units²
};

}  // namespace tracked_mcf
