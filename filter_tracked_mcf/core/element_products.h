#pragma once

#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/element_partition.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/octree.h"

namespace tracked_mcf {

// Products with the matrix A = Σ_e R_eᵀ M_e R_e of a level's symmetric element matrices M_e, which
// is never assembled, R_e picking an element's eight unknowns: less memory than A takes, and
// streamed.

/// residual = right_side - A x.
void subtract_products(const ElementPartition& partition, const MatrixBlocks& matrices,
                       const Field& right_side, const Field& x, Field& residual);

/// The same for x in double precision, a row per unknown, computed in double.
void subtract_products(const Level& level, const MatrixBlocks& matrices, const Field& right_side,
                       const Coefficients& x, Field& residual);

/// y = A x; returns x · y, summed over the coordinates.
double multiply(const ElementPartition& partition, const MatrixBlocks& matrices, const Field& x,
                Field& y);

/// Σ_e R_eᵀ v_e of element vectors.
void sum_vectors(const ElementPartition& partition, const std::vector<ElementVector>& vectors,
                 Field& result);

}  // namespace tracked_mcf
