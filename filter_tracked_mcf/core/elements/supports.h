// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

/// Integrals over the initial surface, per unknown of the finest level, in grid units.
struct Supports {
    std::vector<float> mass;  ///< ∫ B_I²
    std::vector<float> area;  ///< area of the surface in the function's cells
};

/// Returns the integrals of all test functions.
Supports measure_supports(const TrackedElements& elements);

/// Constrains the negligible unknowns: those whose function has a mean square under 1e-8 over its
/// support. In single precision its coefficient would be an amplified rounding error of any size,
/// though the function itself is nearly zero on the surface. A flat part of the surface in a grid
/// plane has a whole layer of such functions, if rounding errors put it across the plane.
void constrain_negligible(const Supports& supports, std::vector<std::uint8_t>& constrained);

}  // namespace tracked_mcf
