// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/octree/octree.h"
#include "filter_tracked_mcf/core/solver/element_partition.h"
#include "filter_tracked_mcf/core/solver/field.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"

namespace tracked_mcf {

// Products with a level's matrix A = Σ_e R_eᵀ M_e R_e. M_e is the symmetric matrix of an element,
// and R_e selects its eight unknowns. A is never assembled: element matrices take less memory, and
// the products read them in order.

/// Computes residual = right_side - A x.
void subtract_products(const ElementPartition& partition, const MatrixBlocks& matrices,
                       const Field& right_side, const Field& x, Field& residual);

/// Computes the same in double for an x in double with one row per unknown.
void subtract_products(const Level& level, const MatrixBlocks& matrices, const Field& right_side,
                       const Coefficients& x, Field& residual);

/// Computes y = A x and returns x · y, summed over the coordinates.
double multiply(const ElementPartition& partition, const MatrixBlocks& matrices, const Field& x,
                Field& y);

/// Computes result = Σ_e R_eᵀ v_e from one vector per element.
void sum_vectors(const ElementPartition& partition, const std::vector<ElementVector>& vectors,
                 Field& result);

}  // namespace tracked_mcf
