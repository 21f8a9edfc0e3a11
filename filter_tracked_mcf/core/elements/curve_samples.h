// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

/// Returns samples on the constrained edges, element by element. `fragments` are in the order of
/// the elements; `constrained_edges` is Domain::constrained_edges.
std::vector<CurveSample> sample_constrained_edges(
    const TrackedElements& elements, const GridMesh& mesh,
    const RawVector<FragmentEntry>& fragments, const std::vector<std::uint8_t>& constrained_edges);

}  // namespace tracked_mcf
