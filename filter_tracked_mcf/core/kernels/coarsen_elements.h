#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"

namespace tracked_mcf {

/// The elements of a level as children of the next coarser one's.
struct ChildElements {
    const MatrixBlock* matrices;
    const std::uint64_t* cells;  ///< of every child, a MortonCode: its last three bits, the octant
    const std::int32_t* children;  ///< of all parents, one after the other
    const std::int64_t* begin;     ///< of every parent's in that, and the end
};

/// Σ_c P_cᵀ M_c P_c over the children c of p is the matrix of p, for p from `begin`, a multiple of
/// kBlockElements, to `end`, another or all parents' number, with P_c the refinement weights of the
/// child's octant (bspline.h). Fastest where children are in the order of their parents.
using CoarsenElements = void(const ChildElements& elements, std::int32_t begin, std::int32_t end,
                             MatrixBlock* parents);

}  // namespace tracked_mcf
