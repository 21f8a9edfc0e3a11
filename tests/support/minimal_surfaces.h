// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The stable catenoid between two unit rings around the z axis, at z = ± distance / 2.
class Catenoid {
public:
    /// `distance` must be at most 1.3254: no catenoid joins unit rings that are farther apart.
    explicit Catenoid(double distance);

    double height() const { return height_; }
    /// Returns a cosh(z / a), where a is the radius of the neck.
    double radius(double z) const;

    /// Returns a point's radius minus the catenoid's radius at the point's z.
    double offset(const Eigen::Vector3d& point) const;

    /// Returns the root mean square of the offsets.
    double rms_offset(const std::vector<Eigen::Vector3d>& points) const;

    /// Returns the root mean square, over the points, of the distance from the catenoid's profile
    /// to its chords between grid planes. This is the error of a function that is trilinear in the
    /// cells and exact in the grid planes, if the axis is along the grid.
    double rms_of_chords(const std::vector<Eigen::Vector3d>& points, const Grid& grid) const;

private:
    double height_;
    double neck_;
};

/// Enneper's minimal surface over a disc. If the radius is less than 1, its boundary spans no other
/// minimal surface.
class Enneper {
public:
    explicit Enneper(double radius) : radius_(radius) {}

    Eigen::Vector3d point(double u, double v) const;

    /// Returns the cone from the origin to the boundary curve, which is not minimal: m rings of n
    /// quads, of which the innermost are triangles.
    TriangleMesh cone(int n, int m) const;

    /// Returns the distance from a nearby point to the surface or its continuation.
    double distance(const Eigen::Vector3d& point) const;

private:
    double radius_;
};

}  // namespace tracked_mcf
