// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/element_matrix.h"

namespace tracked_mcf {

/// Consecutive elements of a level, and where to add what they contribute. `begin` is a multiple of
/// kBlockElements; `end` is one too, or the number of elements.
struct ElementRange {
    /// Offset of a block whose elements add directly to their unknowns.
    static constexpr std::int64_t kDirect = -1;

    const std::int32_t* unknowns;  ///< eight for each element of the level
    /// For each block of kBlockElements of the level: kDirect, or the offset of its targets, which
    /// are stored like unknowns. A target is an unknown, or -1 - s for the slot s.
    const std::int64_t* target_offsets;
    const std::int32_t* targets;
    float* slots;  ///< four floats each
    std::int32_t begin, end;
};

/// Adds factor * R_eᵀ M_e R_e x for each element e of the range to its targets, in y or in the
/// slots. R_e selects an element's eight unknowns; M_e is its matrix, and `matrices` are those of
/// all blocks of the level. x and y have four floats for each unknown, 16-byte aligned; the fourth
/// is zero.
void add_element_products(const ElementRange& range, const MatrixBlock* matrices, float factor,
                          const float* x, float* y);

}  // namespace tracked_mcf
