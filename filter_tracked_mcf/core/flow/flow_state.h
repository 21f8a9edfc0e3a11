// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

/// A scaling about a point, in mesh units.
struct Scaling {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double factor = 1;
};

/// Everything that a step of a flow changes. To undo a step is to keep the state before it.
struct FlowState {
    /// Coefficients of X_t minus the identity, in grid units.
    Coefficients displacement;

    /// Multipliers λ of the curve constraint (curve_constraint.h), as the step to this state used
    /// them.
    std::vector<Eigen::Vector3d> multipliers;

    /// One flag per unknown of the finest level: it keeps its value from now on.
    std::vector<std::uint8_t> constrained;

    /// Of the surface in the first step, grid units²; 0 before it.
    double first_area = 0;

    /// Where the next step may take each connected component, see Confinement, in grid units. Empty
    /// until an area or a volume has been restored: then the initial boxes count.
    std::vector<Eigen::AlignedBox3d> boxes;

    /// What has scaled each connected component after the last step; empty if nothing has. The next
    /// step predicts the same scalings again and solves only for the remainder. Otherwise the
    /// stabilisation, which penalises a change of thickness of the space around the surface, and
    /// the functions that hardly meet the surface would distort the embedding a little at each
    /// scaling.
    std::vector<Scaling> scalings;

    /// Coefficients of the velocity d/δ of the last step, that of order 1, before anything is
    /// preserved; grid units / mesh units². Empty at the start, and unless the plan takes
    /// velocities.
    Coefficients velocity;
};

}  // namespace tracked_mcf
