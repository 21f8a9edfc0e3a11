#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Where the held edges of `elements` are sampled, element by element. `fragments` are in the order
/// of the elements; `held_edges` as Domain::held_edges.
std::vector<HeldSample> sample_held_edges(const TrackedElements& elements, const GridMesh& mesh,
                                          const RawVector<FragmentEntry>& fragments,
                                          const std::vector<std::uint8_t>& held_edges);

}  // namespace tracked_mcf
