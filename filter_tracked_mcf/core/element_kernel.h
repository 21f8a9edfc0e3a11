#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrices.h"

namespace tracked_mcf {

/// What the integrals over one element need.
struct ElementInput {
    /// The embedding X_t minus the identity at the cell's corners, minus its value at corner 0.
    alignas(32) float displacement[3][8];
    const Fragment* fragments;
    const Fragment* fragments_end;
    const Sample* samples;
};

/// What they give, besides matrix and right side.
struct ElementTotals {
    float area = 0;
    std::int32_t collapsed_samples = 0;
    float collapsed_mass[8] = {};  ///< Σ w_p B_I² over the collapsed samples
};

/// Integrates one element by its samples. Compiled for several instruction sets; the best that the
/// processor has is chosen when the program starts.
ElementTotals integrate_element(const ElementInput& input, const SystemWeights& weights,
                                ElementMatrix& matrix, ElementVector& right_side);

}  // namespace tracked_mcf
