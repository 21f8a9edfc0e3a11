// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/kernels/element_matrix.h"
#include "filter_tracked_mcf/core/system/matrix_blocks.h"

namespace tracked_mcf {

/// The weights of the matrix mass * D + δ S.
struct SystemWeights {
    float mass = 1;                ///< 1 in equation 2
    float step_size_in_cells = 0;  ///< δ, in squared sides of a finest cell
    /// D uses the present metric. S uses the present or, in a conformalized flow, the initial one.
    FlowKind flow = FlowKind::MeanCurvature;
    bool keep_stiffness = false;  ///< whether to fill ElementSystems::stiffnesses
};

/// The system of one step on the finest level, element by element.
struct ElementSystems {
    MatrixBlocks matrices;
    MatrixBlocks stiffnesses;  ///< δ S alone, if SystemWeights asks for it
    std::vector<ElementVector> right_sides;
    std::vector<float> areas;  ///< of the embedded surface in each element, grid units²
    double area = 0;           ///< their sum
    std::int64_t collapsed_samples = 0;
    std::vector<Collapse> collapses;  ///< one per element with collapsed samples, in order
};

/// Assembles the element matrices and right-hand sides (SetSystemMatrices, section 4.3).
///
/// The metric is that of the embedding X_t(p) = p + Σ u_I B_I(p), where u is the displacement in
/// grid units:
///
///     matrices           mass * ∫ ρ B_I B_J + δ ∫ ∇B_I · ∇B_J    (equation 4)
///     right-hand sides   -δ ∫ ∇B_I · ∇X_t
///
/// The density ρ is 1 unless the detail size follows the local edge length (densities.h). With mass
/// 1, the solution d = X_{t+δ} - X_t is that of equation 2. In a conformalized flow, the
/// gradients and their integrals use the initial metric.
///
/// The kernels compute in single precision. They take differences within a cell in double first, so
/// rounding errors are relative to the size of the embedded cell. The result has the same bits for
/// any number of threads.
void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       const SystemWeights& weights, ElementSystems& systems);

/// Computes the product of element matrices of the finest level and a vector, element by element.
void multiply(const TrackedElements& elements, const MatrixBlocks& matrices,
              const Coefficients& vector, std::vector<ElementVector>& products);

/// Computes ∫ B_I n over the embedded surface, element by element, with its unit normal n.
void assemble_normals(const TrackedElements& elements, const Coefficients& displacement,
                      std::vector<ElementVector>& normals);

}  // namespace tracked_mcf
