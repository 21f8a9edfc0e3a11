// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/bspline.h"

namespace tracked_mcf {

namespace {

double hat(int bit, double x) {
    return bit ? x : 1 - x;
}

}  // namespace

CornerValues bspline_values(const Eigen::Vector3d& local) {
    CornerValues values;
    for (int corner = 0; corner < 8; ++corner) {
        values[corner] = hat(corner_bit(corner, 0), local[0]) *
                         hat(corner_bit(corner, 1), local[1]) *
                         hat(corner_bit(corner, 2), local[2]);
    }
    return values;
}

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
