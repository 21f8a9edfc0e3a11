#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_partition.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

/// The prolongation P from a level's unknowns to those of the next finer one, and its transpose,
/// element by element: every fine unknown is interpolated in one of its elements, from the eight
/// unknowns of that element's parent. The same as prolongation() of transfer.h without a matrix.
class ElementTransfer {
public:
    ElementTransfer() = default;
    /// The levels must outlive this.
    ElementTransfer(const Level& fine, const Level& coarse);

    /// x += P correction, but for unknowns that are not `movable`.
    void add_prolongated(const Field& correction, const std::vector<std::uint8_t>& movable,
                         Field& x) const;

    /// coarse_residual = Pᵀ residual; `coarse_parts` are those of the coarse level.
    void restrict(const Field& residual, const ElementPartition& coarse_parts,
                  Field& coarse_residual) const;

    /// The fine elements, grouped by parent.
    const Groups& children() const { return children_; }

private:
    const Level* fine_ = nullptr;
    const Level* coarse_ = nullptr;
    Groups children_;
    /// Of every fine element, bit i: its i-th unknown is interpolated in it.
    std::vector<std::uint8_t> owned_;
};

}  // namespace tracked_mcf
