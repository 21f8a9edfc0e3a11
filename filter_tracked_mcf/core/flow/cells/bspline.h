// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace tracked_mcf {

// First-order tensor B-splines on one cell. The eight corners of a cell, and the functions centred
// at them, are numbered 0 to 7: bit 0 is set on the upper side in x, bit 1 in y, bit 2 in z. The
// eight children of a cell, its octants, are numbered alike. Local coordinates in a cell run from 0
// to 1.

/// Returns 1 if a corner lies on the upper side of its cell along an axis, else 0.
constexpr int corner_bit(int corner, int axis) {
    return (corner >> axis) & 1;
}

template <class Number>
using Values = Eigen::Matrix<Number, 8, 1>;
using CornerValues = Values<double>;

/// Returns the values of the eight functions at a point, continued beyond the cell where it lies
/// outside. They sum to 1.
template <class Number>
Values<Number> bspline_values(const Eigen::Matrix<Number, 3, 1>& local) {
    const Eigen::Matrix<Number, 3, 1> hats[2] = {1 - local.array(), local};
    Values<Number> values;
    for (int corner = 0; corner < 8; ++corner) {
        values[corner] = hats[corner_bit(corner, 0)][0] * hats[corner_bit(corner, 1)][1] *
                         hats[corner_bit(corner, 2)][2];
    }
    return values;
}

/// Returns the weights with which the functions of a child cell make up those of its parent: entry
/// (i, J) belongs to corner i of the child in `octant` and corner J of the parent. Entries are 0,
/// 1, 1/2, 1/4 or 1/8. The non-zeros of a row are equal and sum to 1.
Eigen::Matrix<double, 8, 8> refinement_weights(int octant);

}  // namespace tracked_mcf
