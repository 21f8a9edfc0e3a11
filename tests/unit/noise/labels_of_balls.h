// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "tests/support/shapes.h"

namespace tracked_mcf {

/// Returns whether a cell is in a ball whose middle is off the lattice.
inline auto in_ball(double radius) {
    return [radius](const Eigen::Vector3i& at) {
        return (at.cast<double>() + Eigen::Vector3d(0.31, 0.12, -0.23)).norm() < radius;
    };
}

/// Returns the border of a ball of cells of side 1, as their faces.
inline TriangleMesh ball_of_faces(double radius) {
    const int reach = static_cast<int>(radius) + 2;
    return shapes::voxels(-reach, reach, in_ball(radius));
}

/// Returns the border of the same ball by marching cubes.
inline TriangleMesh ball_of_marching_cubes(double radius) {
    const int reach = static_cast<int>(radius) + 2;
    return shapes::marching_cubes(-reach, reach, in_ball(radius));
}

/// Returns the border by marching cubes of the same ball after an average over 27 cells each, about
/// as a blur by half a cell.
inline TriangleMesh averaged_ball(double radius) {
    const int reach = static_cast<int>(radius) + 3;
    return shapes::marching_cubes(-reach, reach, [radius](const Eigen::Vector3i& at) {
        double sum = 0;
        for (int i = 0; i < 27; ++i) {
            const Eigen::Vector3i offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            if (in_ball(radius)(at + offset)) sum += std::pow(6, 3 - offset.cwiseAbs().sum());
        }
        return sum / 512;
    });
}

/// Returns a smooth ball by marching cubes. It is at few fractions of the cells, as it is
/// symmetric.
inline TriangleMesh symmetric_ball() {
    return shapes::marching_cubes(-6, 8, [](const Eigen::Vector3i& at) {
        return 0.5 + (5 - (at.cast<double>().array() - 0.5).matrix().norm()) / 9;
    });
}

}  // namespace tracked_mcf
