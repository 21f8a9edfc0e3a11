#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The stable catenoid between two unit rings around the z axis, at z = ± distance / 2.
class Catenoid {
public:
    /// distance: at most 1.3254, beyond which there is none.
    explicit Catenoid(double distance);

    double height() const { return height_; }
    /// a cosh(z / a), a being the neck's.
    double radius(double z) const;

    /// Of a point: its radius minus the catenoid's at its z.
    double offset(const Eigen::Vector3d& point) const;

    /// Root mean square of the offsets.
    double rms_offset(const std::vector<Eigen::Vector3d>& points) const;

    /// Root mean square over the points of how far the chords of the profile between a grid's
    /// planes are from the profile: what a function that is trilinear in the cells is off by, if
    /// the axis is along the grid and its values in the grid's planes are exact.
    double rms_of_chords(const std::vector<Eigen::Vector3d>& points, const Grid& grid) const;

private:
    double height_;
    double neck_;
};

/// Enneper's surface over the disc of this radius: minimal, and below 1 it is the only one that its
/// boundary spans.
class Enneper {
public:
    explicit Enneper(double radius) : radius_(radius) {}

    Eigen::Vector3d point(double u, double v) const;

    /// The cone from the origin to the boundary curve, which is not minimal: m rings of n quads,
    /// the innermost triangles.
    TriangleMesh cone(int n, int m) const;

    /// From a point nearby to the surface or its continuation.
    double distance(const Eigen::Vector3d& point) const;

private:
    double radius_;
};

}  // namespace tracked_mcf
