#pragma once

#include <vector>

#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

/// The element matrices of the next coarser level: every parent's is Σ P_cᵀ K_c P_c over its
/// children c, with P_c the refinement weights of the child's octant. Assembled, that is exactly
/// the Galerkin product PᵀAP, at a fraction of its cost.
///
/// `fine` is the finer level, `children` its elements grouped by parent.
void coarsen_element_matrices(const Level& fine, const Groups& children,
                              const MatrixBlocks& fine_matrices, MatrixBlocks& coarse_matrices);

/// Sets the rows and columns of a level's frozen unknowns to zero in its element matrices, so that
/// coarse corrections are made for what can follow them.
void leave_out_frozen(const Level& level, const std::vector<std::uint8_t>& frozen,
                      MatrixBlocks& matrices);

}  // namespace tracked_mcf
