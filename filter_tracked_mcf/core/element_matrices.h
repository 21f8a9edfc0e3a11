#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrix.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// What is assembled: mass * D + stiffness * S, grid units.
struct SystemWeights {
    float mass = 1;
    float stiffness = 0;
    /// S of the present metric or, for conformalized flow, of the initial one. D is of the present.
    FlowKind flow = FlowKind::MeanCurvature;
};

/// The finest level's element matrices and right sides, and what was noticed on the way.
struct ElementSystems {
    MatrixBlocks matrices;
    std::vector<ElementVector> right_sides;
    std::vector<float> areas;  ///< of the embedded surface in each element, grid units²
    double area = 0;           ///< their sum
    std::int64_t collapsed_samples = 0;
    std::vector<Collapse> collapses;  ///< of the elements that have any, in order
};

/// SetSystemMatrices (section 4.3), element by element: under the metric of the embedding
/// X_t(p) = p + Σ u_I B_I(p), whose displacement has the coefficients u (grid units),
///
///     matrices     mass * ∫ B_I B_J + stiffness * ∫ ∇B_I · ∇B_J      (equation 4)
///     right sides  -stiffness * ∫ ∇B_I · ∇X_t
///
/// (of a conformalized flow, gradients and their integrals under the initial metric),
/// so that with mass 1 and stiffness δ, solving for d = X_{t+δ} - X_t is equation 2. Single
/// precision: differences within a cell are taken in double first, so what is lost is relative to
/// the embedded cell. Results are the same bits at any number of threads.
void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       const SystemWeights& weights, ElementSystems& systems);

/// Turns systems for d into systems for what d is besides `guess`: takes guess, multiplied by the
/// matrices, from the right sides.
void subtract_guess(const TrackedElements& elements, const Coefficients& guess,
                    ElementSystems& systems);

}  // namespace tracked_mcf
