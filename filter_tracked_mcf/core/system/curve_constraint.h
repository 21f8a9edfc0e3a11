// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"

namespace tracked_mcf {

/// Constrains the surface along the constrained edges by an augmented Lagrangian, and leaves the
/// surface beside them free.
///
/// The constraint adds the force δ (n + λ - η u) along the edges to the displacement's system, in
/// grid units. n is the conormal, which balances the initial surface's own pull on the edge. u is
/// the displacement from the initial position, and η the penalty.
///
/// As the surface moves, its pull turns. The penalty alone would give way by up to 1/η of a cell,
/// so each element has a multiplier λ, zero at the start, which after each step takes over the
/// penalty's mean force in the element. The multipliers belong to the state of the flow. λ is
/// constant in an element and η is moderate because a constraint at every point of a curved
/// boundary would lock its cells. The remaining displacement is of second order in the cell size.
class CurveConstraint {
public:
    /// Groups the samples of the constrained edges by element. `elements` must outlive this.
    explicit CurveConstraint(const TrackedElements& elements);

    /// Returns the multipliers λ at the start.
    std::vector<Eigen::Vector3d> zero_multipliers() const {
        return std::vector<Eigen::Vector3d>(runs_.size(), Eigen::Vector3d::Zero());
    }

    /// Adds the constraint to the finest level's system, for the step size δ in squared sides of a
    /// cell and the embedding with this displacement.
    void add(const Coefficients& displacement, const std::vector<Eigen::Vector3d>& multipliers,
             double step_size_in_cells, ElementSystems& systems) const;

    /// Returns the multipliers after a step, given those before it and the displacement that the
    /// step has led to.
    std::vector<Eigen::Vector3d> updated(std::vector<Eigen::Vector3d> multipliers,
                                         const Coefficients& displacement) const;

private:
    /// Consecutive samples of constrained edges in one element.
    struct Run {
        std::int32_t element;
        std::size_t begin, end;  ///< indices into TrackedElements::curve_samples
    };

    const TrackedElements& elements_;
    std::vector<Run> runs_;
};

}  // namespace tracked_mcf
