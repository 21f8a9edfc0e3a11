// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"
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

/// Returns equation 4 for an element with its samples.
inline Equation4 integrate(const TrackedElements& elements, const Matrix83& embedding,
                           std::int32_t element) {
    Equation4 equation;
    std::int64_t sample = elements.sample_begin[element];
    for (std::int64_t f = elements.fragment_begin[element];
         f < elements.fragment_begin[element + 1]; ++f) {
        const Fragment& fragment = elements.fragments[f];
        const Eigen::Vector3d normal =
            Eigen::Map<const Eigen::Vector3f>(fragment.normal).cast<double>();
        for (std::int32_t i = 0; i < fragment.sample_count; ++i, ++sample) {
            equation.add_sample(normal, elements.samples.local(sample),
                                elements.samples.weight(sample), embedding);
        }
    }
    return equation;
}

/// Returns all entries of a matrix.
inline Matrix8 whole(const ElementMatrix& matrix) {
    Matrix8 entries;
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column)
            entries(row, column) = double{matrix(row, column)};
    }
    return entries;
}

}  // namespace tracked_mcf
