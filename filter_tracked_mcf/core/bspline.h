#pragma once

#include <Eigen/Core>

namespace tracked_mcf {

/// First-order tensor B-splines on one cell. A cell's eight corners, and the functions centred at
/// them, are numbered 0 to 7: bit 0 is set on the upper side in x, bit 1 in y, bit 2 in z. The
/// cell's eight children, its octants, are numbered alike. Local coordinates run from 0 to 1.
constexpr int corner_bit(int corner, int axis) {
    return (corner >> axis) & 1;
}

using CornerValues = Eigen::Matrix<double, 8, 1>;
using CornerGradients = Eigen::Matrix<double, 8, 3>;

/// Values of the eight functions at a point with these local coordinates; they sum to 1.
CornerValues bspline_values(const Eigen::Vector3d& local);

/// Their gradients, a row each, per side of the cell; the rows sum to 0.
CornerGradients bspline_gradients(const Eigen::Vector3d& local);

/// Refinement: entry (i, J) is the weight of the function at corner i of the child in `octant` in
/// the function at corner J of the parent: 0, 1, 1/2, 1/4 or 1/8. A row's non-zeros are all equal
/// and sum to 1.
Eigen::Matrix<double, 8, 8> refinement_weights(int octant);

}  // namespace tracked_mcf
