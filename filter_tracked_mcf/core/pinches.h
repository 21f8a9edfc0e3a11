#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Anchors what has pinched (section 5.1). A test function of which more than half, measured by
/// ∫ B_I² over the initial surface, lies where samples have collapsed is hardly held by the
/// equations any more: a little rest of its support would fling the vertices under it about. From
/// then on its coefficient stays what it is.
class Pinches {
public:
    explicit Pinches(const TrackedElements& elements) : elements_(elements) {}

    /// Marks in `frozen` (of every unknown of the finest level) the functions that have pinched
    /// under the metric that `systems` was assembled with.
    void freeze(const ElementSystems& systems, std::vector<std::uint8_t>& frozen);

private:
    const TrackedElements& elements_;
    std::vector<float> initial_mass_;  ///< ∫ B_I² of every unknown; made when first needed
};

}  // namespace tracked_mcf
