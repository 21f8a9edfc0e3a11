#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"
#include "filter_tracked_mcf/core/surface_samples.h"

namespace tracked_mcf {

/// What the integrals over one element need.
struct ElementInput {
    /// The embedding X_t minus the identity at the cell's corners, minus its value at corner 0.
    alignas(32) float displacement[3][8];
    const Fragment* fragments;
    const Fragment* fragments_end;
    const Sample* samples;
    float mass;           ///< weight of ∫ B_I B_J
    float stiffness;      ///< weight of ∫ ∇B_I · ∇B_J
    bool initial_metric;  ///< the stiffness is that of the initial surface; then nothing collapses
};

/// What they give, besides matrix and right side.
struct ElementTotals {
    float area;  ///< of the embedded surface, grid units²
    std::int32_t collapsed_samples;
    float collapsed_mass[8];  ///< Σ w_p B_I² over the collapsed samples
};

/// Integrates one element by its samples; see assemble_elements.
using IntegrateElement = ElementTotals(const ElementInput& input, ElementMatrix& matrix,
                                       ElementVector& right_side);

}  // namespace tracked_mcf
