// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/system/matrix_blocks.h"

namespace tracked_mcf {

/// Takes from a step the translation of each component that nothing constrains. Constants are in
/// the null spaces of S and N, so equation 2 says that 1ᵀ D d = 0: the centroid, weighted by mass,
/// stays. Where δ S is so large that single precision loses D beside it, a solution does not know
/// this. `masses` are the matrices of D, element by element, and `constrained` are flags of the
/// components that something constrains.
void remove_drift(const TrackedElements& elements, const MatrixBlocks& masses,
                  const std::vector<std::uint8_t>& constrained, Coefficients& step);

}  // namespace tracked_mcf
