// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// The system of one step on the finest level, element by element.
struct ElementSystems {
    MatrixBlocks matrices;
    MatrixBlocks stiffnesses;  ///< δ S alone, if it was asked for
    Eigen::Matrix<float, 4, Eigen::Dynamic>
        right_sides;           ///< x, y, z, 0 at each corner of an element
    std::vector<float> areas;  ///< of the embedded surface in each element, grid units²
    double area = 0;           ///< their sum
    std::int64_t collapsed_samples = 0;
};

/// Assembles the element matrices and right-hand sides (SetSystemMatrices, section 4.3).
///
/// The metric is that of the embedding X_t(p) = p + Σ u_I B_I(p), where u is the displacement in
/// grid units:
///
///     matrices           ∫ B_I B_J + δ ∫ ∇B_I · ∇B_J    (equation 4)
///     right-hand sides   -δ ∫ ∇B_I · ∇X_t
///
/// The step size δ is in squared sides of a finest cell. The solution d = X_{t+δ} - X_t is that of
/// equation 2. `keep_stiffness` asks for ElementSystems::stiffnesses.
///
/// The integrals are computed in single precision. Differences within a cell are taken in double
/// first, so rounding errors are relative to the size of the embedded cell. The result has the same
/// bits for any number of threads.
void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       double step_size, bool keep_stiffness, ElementSystems& systems);

/// Computes the product of element matrices of the finest level and a vector, element by element.
void multiply(const TrackedElements& elements, const MatrixBlocks& matrices,
              const Coefficients& vector, Eigen::Matrix<float, 4, Eigen::Dynamic>& products);

}  // namespace tracked_mcf
