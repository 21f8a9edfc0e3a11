#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/supports.h"

namespace tracked_mcf {

/// Anchors what has pinched (section 5.1): marks in `frozen` (of every unknown of the finest level)
/// the test functions of which more than a hundredth, measured by ∫ B_I² over the initial surface,
/// lies where samples have collapsed under the metric that `systems` was assembled with. Collapsed
/// samples have no say in the equations, so a function that goes on moving would take them anywhere
/// at no cost, and the better the equations are solved, the farther. From then on its coefficient
/// stays what it is.
void freeze_pinched(const TrackedElements& elements, const Supports& supports,
                    const ElementSystems& systems, std::vector<std::uint8_t>& frozen);

}  // namespace tracked_mcf
