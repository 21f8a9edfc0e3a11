#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Connected parts of the surface that have shrunk to next to nothing, while others have not, in a
/// flow in which samples do not collapse. Next to the stiffness nothing is left of such a part's
/// mass, and so nothing that says where it is.
///
/// Without separated sheets parts cannot be told from each other and count as one.
class VanishedParts {
public:
    /// `elements` must outlive this.
    explicit VanishedParts(const TrackedElements& elements);

    /// Marks in `frozen` (of every unknown of the finest level) the test functions of parts of
    /// whose initial area less than `share` is left under the metric of `systems`.
    void freeze(const ElementSystems& systems, double share,
                std::vector<std::uint8_t>& frozen) const;

private:
    const TrackedElements& elements_;
    std::vector<std::int32_t> part_of_;  ///< of every finest element
    std::vector<double> initial_areas_;  ///< of every part, grid units²
};

}  // namespace tracked_mcf
