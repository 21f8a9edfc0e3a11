#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// How much of the initial surface every test function of the finest level holds, grid units².
struct Supports {
    std::vector<float> mass;  ///< ∫ B_I²
    std::vector<float> area;  ///< of the surface in the function's cells
};

Supports measure_supports(const TrackedElements& elements);

/// Marks in `frozen` the functions that hardly meet the surface: those whose mean square over their
/// support is lost in single precision beside a function that is 1 there. They make next to no
/// difference where they are, but their coefficients would be rounding errors blown up, of any
/// size. A flat part that lies in a grid plane but for rounding, as one in the middle of a model
/// does, has a whole layer of them.
void freeze_negligible(const Supports& supports, std::vector<std::uint8_t>& frozen);

}  // namespace tracked_mcf
