// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/element_matrix.h"

namespace tracked_mcf {

/// The elements of a level, grouped by their parents in the next coarser level.
struct ChildElements {
    const MatrixBlock* matrices;
    const std::uint64_t* cells;    ///< MortonCode of each child; its lowest three bits: the octant
    const std::int32_t* children;  ///< grouped by parent
    const std::int64_t* begin;     ///< offset in `children` for each parent, and the end
};

/// Sets the matrix of each parent p in [begin, end) to Σ_c P_cᵀ M_c P_c over the children c of p.
/// P_c are the refinement weights of the child's octant (bspline.h). `begin` is a multiple of
/// kBlockElements; `end` is one too, or the number of parents. Fastest if the children of
/// consecutive parents are consecutive elements.
void coarsen_elements(const ChildElements& elements, std::int32_t begin, std::int32_t end,
                      MatrixBlock* parents);

}  // namespace tracked_mcf
