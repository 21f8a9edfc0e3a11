#include "filter_tracked_mcf/core/bspline.h"

namespace tracked_mcf {

namespace {

double hat(int bit, double x) {
    return bit ? x : 1 - x;
}
double hat_slope(int bit) {
    return bit ? 1 : -1;
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

CornerGradients bspline_gradients(const Eigen::Vector3d& local) {
    CornerGradients gradients;
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            const int second = (axis + 1) % 3;
            const int third = (axis + 2) % 3;
            gradients(corner, axis) = hat_slope(corner_bit(corner, axis)) *
                                      hat(corner_bit(corner, second), local[second]) *
                                      hat(corner_bit(corner, third), local[third]);
        }
    }
    return gradients;
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
