// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Throws InvalidMesh if the longest side of a box is too large or too small for doubles, or so
/// small beside the distance from the origin that coordinates cannot resolve it.
void check_box(const Eigen::AlignedBox3d& box);

/// Returns the normal of the triangle abc; its length is twice the triangle's area.
inline Eigen::Vector3d twice_vector_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
    return (b - a).cross(c - a);
}

/// Returns whether a triangle's area is at most `ratio` times the square of its longest edge.
inline bool is_thin(const std::array<Eigen::Vector3d, 3>& corners, double ratio) {
    const auto& [a, b, c] = corners;
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double least = 2 * ratio * longest;
    return twice_vector_area(a, b, c).squaredNorm() <= least * least;
}

/// A triangle is degenerate if it is thin with this ratio. In double precision it has no plane
/// then.
inline constexpr double kDegenerate = 1e-12;

/// Returns the sum of the lengths of a triangle's sides.
inline double perimeter(const std::array<Eigen::Vector3d, 3>& corners) {
    const auto& [a, b, c] = corners;
    return (b - a).norm() + (c - b).norm() + (a - c).norm();
}

/// Returns the mean length of the sides of the selected triangles that have three different
/// corners, in units of the mesh; 0 if there are none.
double mean_edge_length(const TriangleMesh& mesh, const Selection& selection = {});

/// Returns the volume that a triangle sweeps when its corners move from `initial` to `present`
/// along straight lines, in cubed units of the mesh; positive along its normal. The sum over a
/// closed surface is the change of its enclosed volume.
double swept_volume(const std::array<Eigen::Vector3d, 3>& initial,
                    const std::array<Eigen::Vector3d, 3>& present);

/// Returns the rate at which swept_volume() grows when the corners move on at these velocities.
double swept_volume_rate(const std::array<Eigen::Vector3d, 3>& initial,
                         const std::array<Eigen::Vector3d, 3>& present,
                         const std::array<Eigen::Vector3d, 3>& velocities);

/// Returns the positions of a triangle's corners.
inline std::array<Eigen::Vector3d, 3> corners_of(const std::vector<Eigen::Vector3d>& positions,
                                                 const Triangle& triangle) {
    // Coordinate by coordinate: compilers write a copied vector in other pieces than they read it
    // in, for which processors wait, up to four times as long as an area takes.
    const auto corner = [&](int i) {
        const Eigen::Vector3d& x = positions[triangle[i]];
        return Eigen::Vector3d(x.x(), x.y(), x.z());
    };
    return {corner(0), corner(1), corner(2)};
}

}  // namespace tracked_mcf
