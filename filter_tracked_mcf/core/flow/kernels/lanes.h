// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace tracked_mcf::kernels {

/// Four floats, one for each of four elements or samples. Every x86-64 and ARM64 processor has such
/// vectors.
using Lanes = Eigen::Array4f;
constexpr int kLanes = 4;

inline Lanes load(const float* from) {
    return Eigen::Map<const Lanes>(from);
}
inline void store(const Lanes& lanes, float* to) {
    Eigen::Map<Lanes>{to} = lanes;
}
inline Lanes splat(float value) {
    return Lanes::Constant(value);
}
inline Lanes zero() {
    return Lanes::Zero();
}
template <int kCount>
inline void set_zero(Lanes (&lanes)[kCount]) {
    for (Lanes& of_one : lanes) of_one.setZero();
}

/// Transposes a square matrix of rows.
inline void transpose(Lanes (&rows)[kLanes]) {
    Eigen::Array44f square;
    for (int i = 0; i < kLanes; ++i) square.col(i) = rows[i];
    square.transposeInPlace();
    for (int i = 0; i < kLanes; ++i) rows[i] = square.col(i);
}

/// Sums the lanes of each of kLanes variables. Lane v of the result is the sum of variable v.
inline Lanes sums_of_lanes(const Lanes* variables) {
    Lanes rows[kLanes] = {variables[0], variables[1], variables[2], variables[3]};
    transpose(rows);
    return (rows[0] + rows[1]) + (rows[2] + rows[3]);
}

}  // namespace tracked_mcf::kernels
