// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"

namespace tracked_mcf {

/// Where a step may take the surface. Both flows obey a maximum principle for each coordinate: a
/// connected component stays within its bounding box. Steps of greater order, and the error of the
/// grid, take it out by a little. A step that takes it further has failed.
class Confinement {
public:
    /// A step may leave the box by this fraction of the diagonal of the whole initial surface, and
    /// this part of a cell, because the grid's functions obey the principle only nearly. One of
    /// order 2 or more may also leave it by this fraction of the length of the waves that it
    /// halves, but not more than this fraction of the diagonal.
    static constexpr double kMarginInDiagonals = 0.01, kMarginInCells = 0.1, kMarginInDetail = 0.1;

    /// Measures the initial boxes. `elements` must outlive the confinement. `detail_size` is the
    /// length of these waves, in grid units, or 0 if the steps have order 1.
    Confinement(const TrackedElements& elements, double detail_size);

    /// Returns the box, with the margin, of each component of the surface with this displacement.
    std::vector<Eigen::AlignedBox3d> boxes(const Coefficients& displacement) const;

    /// Returns whether all vertices that can move are within these boxes of their components, or
    /// the initial ones if there are none.
    bool holds(const Coefficients& displacement,
               const std::vector<Eigen::AlignedBox3d>& boxes = {}) const;

private:
    void add_margin(std::vector<Eigen::AlignedBox3d>& boxes) const;
    /// Returns the position of a vertex that has an element, in grid units.
    Eigen::Vector3d position(const Coefficients& displacement, std::int32_t vertex) const;

    const TrackedElements& elements_;
    double margin_ = 0;  ///< grid units
    std::vector<Eigen::AlignedBox3d>
        initial_boxes_;  ///< per component, grid units, with the margin
};

}  // namespace tracked_mcf
