// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// Returns the boundary lock of section 5.3: one flag for each level (coarsest first) and unknown,
/// set if the support of its function meets a constrained edge.
///
/// Constrained unknowns of the displacement are zero on every level: on the finest so that the
/// surface there stays, on the coarser ones so that corrections respect that. The support of a
/// coarse function contains the supports of its fine functions, so a free coarse function contains
/// no constrained fine one.
std::vector<std::vector<std::uint8_t>> constrained_unknowns(const TrackedElements& elements);

/// Constrains the negligible unknowns of the finest level: those whose function has a mean square
/// under 1e-8 over its support. In single precision its coefficient would be an amplified rounding
/// error of any size, though the function itself is nearly zero on the surface. A flat part of the
/// surface in a grid plane has a whole layer of such functions, if rounding errors put it across
/// the plane.
void constrain_negligible(const TrackedElements& elements, std::vector<std::uint8_t>& constrained);

/// Sets the rows and columns of constrained unknowns to zero in a level's element matrices. Coarser
/// levels then take only free unknowns into account.
void eliminate_constrained(const Level& level, const std::vector<std::uint8_t>& constrained,
                           MatrixBlocks& matrices);

/// Returns whether an unknown with this diagonal entry of the assembled matrix is free. A function
/// with a smaller entry is invisible on the surface, and its inverse would overflow. Written so
/// that a NaN propagates.
inline bool is_free(float diagonal) {
    return !(diagonal <= 1e-30F);
}

}  // namespace tracked_mcf
