#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/supports.h"

namespace tracked_mcf {

/// From what share of it on a function counts as pinched. Collapsed samples have no say in the
/// equations, so a function that goes on moving takes its collapsed part anywhere at no cost, and
/// the better the equations are solved, the farther. Measured in long flows of scans: with a larger
/// share the converged solver flings vertices about, with a smaller one stubs stay rough.
inline constexpr float kPinchedShareConverged = 0.05F;
inline constexpr float kPinchedShareOneWCycle = 0.5F;

/// Anchors what has pinched (section 5.1): marks in `frozen` (of every unknown of the finest level)
/// the test functions of which more than `pinched_share`, measured by ∫ B_I² over the initial
/// surface, lies where samples have collapsed under the metric that `systems` was assembled with.
/// From then on its coefficient stays what it is.
void freeze_pinched(const TrackedElements& elements, const Supports& supports,
                    const ElementSystems& systems, float pinched_share,
                    std::vector<std::uint8_t>& frozen);

}  // namespace tracked_mcf
