// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/bspline.h"

namespace tracked_mcf {

Eigen::Matrix<double, 8, 8> refinement_weights(int octant) {
    Eigen::Matrix<double, 8, 8> weights;
    for (int child_corner = 0; child_corner < 8; ++child_corner) {
        Eigen::Vector3d in_parent;
        for (int axis = 0; axis < 3; ++axis) {
            in_parent[axis] = 0.5 * (corner_bit(octant, axis) + corner_bit(child_corner, axis));
        }
        weights.row(child_corner) = bspline_values(in_parent).transpose();
    }
    return weights;
}

}  // namespace tracked_mcf
