// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/paper/level_matrix.h"

namespace tracked_mcf {

/// Gauss-Seidel in the lexicographic order of the unknowns' corners, z slowest. This order reduces
/// the error of these systems about twice as much as an order by colours. The unknowns are cut into
/// slabs of whole layers. A sweep visits every other slab, and then the rest. Slabs of one half do
/// not touch, so threads can sweep them at the same time. The cuts do not depend on the number of
/// threads, so neither do the bits.
class GaussSeidel {
public:
    explicit GaussSeidel(const Level& level);

    /// Makes one sweep over A x = right_side in place. Keeps unknowns with inverse diagonal 0.
    void sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const;

private:
    std::vector<std::int32_t> order_;       ///< unknowns in lexicographic order
    std::vector<std::int32_t> slab_begin_;  ///< offset of each slab in order_, and the end
};

}  // namespace tracked_mcf
