// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/cells/bspline.h"

namespace tracked_mcf {

using CornerGradients = Eigen::Matrix<double, 8, 3>;

/// Returns the gradients of a cell's eight functions, one per row, in local coordinates. The core
/// never forms them; tests compare its integrals with theirs.
inline CornerGradients bspline_gradients(const Eigen::Vector3d& local) {
    const auto hat = [&](int corner, int axis) {
        return corner_bit(corner, axis) != 0 ? local[axis] : 1 - local[axis];
    };
    CornerGradients gradients;
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            const double slope = corner_bit(corner, axis) != 0 ? 1 : -1;
            gradients(corner, axis) =
                slope * hat(corner, (axis + 1) % 3) * hat(corner, (axis + 2) % 3);
        }
    }
    return gradients;
}

}  // namespace tracked_mcf
