// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// Additive Schwarz smoother over the elements: x += S r with S = Σ_e R_eᵀ (A_e⁻¹ / m_e) R_e. The
/// smoother solves for the eight unknowns of each element together, all from the same residual. It
/// damps an element's correction by 1 / m_e, where m_e is the number of elements that share the
/// element's most shared unknown. S is symmetric.
///
/// The functions around an element are nearly dependent on the surface in it. Gauss-Seidel, which
/// changes one unknown at a time, needs tens of sweeps to do what one solve of all eight does. A
/// damping factor per element, unlike one per unknown, keeps nearly dependent corrections nearly
/// dependent: the largest eigenvalue of S A is below 2, unless sheets of the surface share
/// functions.
class ElementSmoother {
public:
    /// Both arguments must outlive this.
    ElementSmoother(const Level& level, const ElementPartition& partition);

    /// Takes the level's element matrices.
    void refresh(const MatrixBlocks& matrices);

    /// Computes x = base + factor * S residual. A null base is zero; the base may be x itself. Only
    /// free unknowns differ from the base.
    void correct(const Field* base, float factor, const Field& residual, Field& x) const;

    /// Returns for each unknown whether it is free (not 0).
    const std::vector<std::uint8_t>& free_unknowns() const { return free_unknowns_; }

private:
    const Level& level_;
    const ElementPartition& partition_;
    std::vector<float> damping_;  ///< 1 / m_e for each element
    MatrixBlocks inverses_;
    std::vector<std::uint8_t> free_unknowns_;
};

}  // namespace tracked_mcf
