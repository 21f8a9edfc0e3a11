// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "filter_tracked_mcf/core/flow/octree/octree.h"

namespace tracked_mcf {

/// A vector of the linear system for the three coordinates at once. Each unknown has a column: x,
/// y, z, and a zero that pads the column to a 16-byte register.
using Field = Eigen::Matrix<float, 4, Eigen::Dynamic>;

/// Sets `field` to `count` zero columns.
void set_zero(Field& field, Eigen::Index count);

/// Sums what the elements of a level contribute to each unknown, in their order. `at_corners` has
/// eight columns for each element.
void sum_at_unknowns(const Level& level, const Field& at_corners, Field& sums);

/// Copies `from` to `to`.
void copy(const Field& from, Field& to);

/// Returns the scalar product of each coordinate, summed in double in a fixed order.
Eigen::Vector4d dot(const Field& a, const Field& b);

/// Returns the 2-norm over all unknowns and coordinates, summed in double in a fixed order.
double norm(const Field& field);

}  // namespace tracked_mcf
