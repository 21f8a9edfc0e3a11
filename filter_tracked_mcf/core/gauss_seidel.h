#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/level_matrix.h"

namespace tracked_mcf {

/// Gauss-Seidel in the lexicographic order of the unknowns' corners, z slowest, which reduces the
/// error of these systems about twice as well as an order by colours. To run in parallel, the
/// unknowns are cut into slabs of whole layers: first every other slab is swept, then the rest.
/// Slabs of one half do not touch, and where they are cut does not depend on the number of threads,
/// so neither do the bits.
class GaussSeidel {
public:
    explicit GaussSeidel(const Level& level);

    /// One sweep over A x = right_side, in place. Unknowns with inverse diagonal 0 stay.
    void sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const;

    /// The unknowns as a sweep visits them, but for the two halves.
    const std::vector<std::int32_t>& order() const { return order_; }

private:
    void sweep_half(const LevelMatrix& matrix, const Field& right_side, Field& x,
                    std::int64_t first_slab) const;

    std::vector<std::int32_t> order_;
    std::vector<std::int32_t> slab_begin_;  ///< where every slab begins in it, and the end
};

}  // namespace tracked_mcf
