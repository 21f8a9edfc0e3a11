#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_blocks.h"
#include "filter_tracked_mcf/core/element_partition.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/kernels/local_systems.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/octree.h"

namespace tracked_mcf {

/// Additive Schwarz over the elements: from one residual, the eight unknowns of every element are
/// solved for together, and the corrections, each divided by how many elements share the most
/// shared of its unknowns, are added up: x += S r with S = Σ_e R_eᵀ (A_e⁻¹ / m_e) R_e.
///
/// What makes these systems hard is that the functions around an element are nearly dependent on
/// the surface in it; Gauss-Seidel, which moves one of them at a time, takes tens of sweeps for
/// what a solve of all eight does at once. With these divisors, one for an element and not one for
/// an unknown, what is nearly dependent stays so, and the largest eigenvalue of S A is less
/// than 2, unless parts of the surface have pinched. S is symmetric.
class ElementSmoother {
public:
    /// All must outlive this.
    ElementSmoother(const Level& level, const ElementBlocks& blocks,
                    const ElementPartition& partition);

    /// Takes the level's element matrices, in which the rows and columns of unknowns that must not
    /// move are zero. `workspace` is for use during the call; its content does not matter.
    void refresh(const MatrixBlocks& matrices, std::vector<Couplings>& workspace);

    /// x += factor * S residual. What may not move, does not.
    void add_correction(float factor, const Field& residual, Field& x) const;

    /// x = factor * S residual.
    void correct(float factor, const Field& residual, Field& x) const;

    /// An estimate of the largest eigenvalue of S A from below, A being the matrix of these element
    /// matrices: by some steps of the power method, always from the same start.
    double largest_eigenvalue(const MatrixBlocks& matrices) const;

    /// Of every unknown: whether something constrains it (not 0); what may not move has nothing.
    const std::vector<std::uint8_t>& movable() const { return movable_; }

private:
    CoupledElements coupled(std::int32_t begin, std::int32_t end) const;
    void correct(const Field* base, float factor, const Field& residual, Field& x) const;

    const Level& level_;
    const ElementBlocks& blocks_;
    const ElementPartition& partition_;
    std::vector<float> shares_;         ///< of every element, 1 / m_e
    std::vector<std::uint32_t> apart_;  ///< of every element, see CoupledElements
    MatrixBlocks inverses_;
    std::vector<std::uint8_t> movable_;
};

}  // namespace tracked_mcf
