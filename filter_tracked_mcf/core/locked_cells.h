#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// The boundary lock of section 5.3: for every level (coarsest first) and unknown, whether the
/// support of its test function meets a held edge. Locked unknowns of the displacement stay zero
/// on every level: at the finest so that the surface there keeps its place, at the coarser so that
/// corrections respect that. A coarse function that is not locked contains no fine one that is.
std::vector<std::vector<std::uint8_t>> unknowns_meeting_held_edges(const TrackedElements& elements);

/// The same for a free boundary: nothing is locked.
std::vector<std::vector<std::uint8_t>> no_unknowns(const TrackedElements& elements);

}  // namespace tracked_mcf
