#pragma once

#include <Eigen/Core>

namespace tracked_mcf {

/// A vector of the linear system, three right sides at once: a column per unknown with its x, y and
/// z, and a zero that fills the column up to one 16-byte register.
using Field = Eigen::Matrix<float, 4, Eigen::Dynamic>;

/// Makes it a field of `count` zeros.
void set_zero(Field& field, Eigen::Index count);

/// to = from.
void copy(const Field& from, Field& to);

/// Scalar product of every coordinate, summed in double in a fixed order.
Eigen::Vector4d dot(const Field& a, const Field& b);

/// 2-norm over unknowns and coordinates, summed in double in a fixed order.
double norm(const Field& field);

}  // namespace tracked_mcf
