// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Compares bits: unlike ==, it distinguishes -0 from 0, and a NaN equals itself.
inline bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const auto bits_of = [](const Eigen::Vector3d& vector) {
        std::array<std::uint64_t, 3> bits{};
        std::memcpy(bits.data(), vector.data(), sizeof(bits));
        return bits;
    };
    return bits_of(a) == bits_of(b);
}

inline bool same_bits(const std::vector<Eigen::Vector3d>& a,
                      const std::vector<Eigen::Vector3d>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& p, const auto& q) { return same_bits(p, q); });
}

inline bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
    return same_bits(a.positions, b.positions);
}

}  // namespace tracked_mcf
