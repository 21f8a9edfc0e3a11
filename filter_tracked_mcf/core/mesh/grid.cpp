// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/grid.h"

#include <cmath>

namespace tracked_mcf {

namespace {

/// Side of the cube over the longest side of the model. The margin keeps the model off the cube's
/// faces.
constexpr double kCubeToModel = 1.1;

}  // namespace

Grid enclosing_grid(const Eigen::AlignedBox3d& box, int depth) {
    const double cube_side = kCubeToModel * box.sizes().maxCoeff();
    const Eigen::Vector3d origin = box.center() - Eigen::Vector3d::Constant(0.5 * cube_side);
    return with_depth({origin, cube_side, 0}, depth);
}

Grid cube_around(const Eigen::AlignedBox3d& box) {
    const double side = kCubeToModel * box.sizes().maxCoeff();
    const Eigen::Vector3d margin = side * Eigen::Vector3d(0.0312, 0.0437, 0.0359);
    return {box.center().array() - box.sizes().maxCoeff() / 2 - margin.array(), side, 0};
}

Grid with_depth(const Grid& grid, int depth) {
    return {grid.origin, std::ldexp(grid.cell_size, grid.depth - depth), depth};
}

}  // namespace tracked_mcf
