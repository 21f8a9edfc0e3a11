// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "tests/support/bspline_gradients.h"

namespace tracked_mcf {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix83 = Eigen::Matrix<double, 8, 3>;

/// Equation 4 for one element as in the paper, in double precision with two tangents: the metric
/// from the embedding's coefficients, then a sum over the samples.
struct Equation4 {
    Matrix8 mass = Matrix8::Zero();
    Matrix8 stiffness = Matrix8::Zero();
    double area = 0;
    int collapsed = 0;  ///< samples

    /// Adds a sample, with this weight of a quadrature, at a place in the unit cell whose corners
    /// the rows of `embedding` are.
    void add_sample(const Eigen::Vector3d& normal, const Eigen::Vector3d& local, double weight,
                    const Matrix83& embedding) {
        Eigen::Matrix<double, 3, 2> tangents;
        tangents.col(0) = normal.unitOrthogonal();
        tangents.col(1) = normal.normalized().cross(tangents.col(0));
        const CornerValues values = bspline_values(local);
        const Eigen::Matrix<double, 8, 2> slopes = bspline_gradients(local) * tangents;
        const Eigen::Matrix<double, 3, 2> dx = embedding.transpose() * slopes;
        const Eigen::Matrix2d g = dx.transpose() * dx;
        const double stretched = dx.col(0).cross(dx.col(1)).norm();
        if (stretched <= 1e-4) {
            ++collapsed;
            return;
        }
        mass += stretched * weight * values * values.transpose();
        stiffness += stretched * weight * slopes * g.inverse() * slopes.transpose();
        area += stretched * weight;
    }
};

}  // namespace tracked_mcf
