// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

/// The prolongation P from a level's unknowns to those of the next finer level, and its transpose,
/// without a matrix. Each fine unknown is interpolated in one of its elements, from the eight
/// unknowns of that element's parent.
class ElementTransfer {
public:
    ElementTransfer() = default;
    /// The levels must outlive this.
    ElementTransfer(const Level& fine, const Level& coarse);

    /// Computes x += P correction, except for unknowns that are not free.
    void add_prolongated(const Field& correction, const std::vector<std::uint8_t>& free_unknowns,
                         Field& x) const;

    /// Computes coarse_residual = Pᵀ residual; `coarse_partition` is that of the coarse level.
    void restrict(const Field& residual, const ElementPartition& coarse_partition,
                  Field& coarse_residual) const;

    /// Computes the element matrices of the coarser level: each parent's is Σ P_cᵀ K_c P_c over its
    /// children c, with the refinement weights P_c of the child's octant. Assembled, they are the
    /// Galerkin product PᵀAP, at a fraction of its cost.
    void coarsen(const MatrixBlocks& fine, MatrixBlocks& coarse) const;

private:
    const Level* fine_ = nullptr;
    const Level* coarse_ = nullptr;
    Groups children_;  ///< fine elements, by parent
    /// For each fine element a mask of corners whose unknowns are interpolated in this element.
    std::vector<std::uint8_t> owned_;
};

}  // namespace tracked_mcf
