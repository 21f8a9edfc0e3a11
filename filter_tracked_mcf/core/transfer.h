#pragma once

#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/sparse_matrix.h"

namespace tracked_mcf {

/// The prolongation P from the unknowns of `coarse` (columns) to those of `fine` (rows): a coarse
/// B-spline is Σ_i P_iJ b_i, the sum of finer ones with weights 1, 1/2, 1/4 and 1/8. Fine functions
/// that the tree lacks vanish on the surface, so that holds exactly there.
SparseMatrix prolongation(const Level& fine, const Level& coarse);

/// The restriction Pᵀ of a prolongation P.
SparseMatrix transposed(const SparseMatrix& matrix);

}  // namespace tracked_mcf
