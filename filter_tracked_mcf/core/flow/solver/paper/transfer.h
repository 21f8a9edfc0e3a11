// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/paper/sparse_matrix.h"

namespace tracked_mcf {

/// Returns the prolongation P from the unknowns of `coarse` (columns) to those of `fine` (rows). A
/// coarse B-spline is Σ_i P_iJ b_i, a sum of finer ones with the weights 1, 1/2, 1/4 and 1/8. Fine
/// functions that the octree lacks vanish on the surface, so this is exact there.
///
/// ElementTransfer applies the same P without a matrix, but it sums in another order, and so its
/// rounding errors differ.
SparseMatrix prolongation(const Level& fine, const Level& coarse);

}  // namespace tracked_mcf
