// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A surface by reference: triangles, and positions that need not be those of their mesh.
struct SurfaceView {
    SurfaceView(const std::vector<Eigen::Vector3d>& vertex_positions,
                const std::vector<Triangle>& vertex_indices)
        : positions(vertex_positions), triangles(vertex_indices) {}
    SurfaceView(const TriangleMesh& mesh) : SurfaceView(mesh.positions, mesh.triangles) {}

    const std::vector<Eigen::Vector3d>& positions;
    const std::vector<Triangle>& triangles;
};

/// Returns the bounding box of the referenced vertices. Throws InvalidMesh if it is a point, if its
/// longest side is too large or too small for doubles, or so small beside the distance from the
/// origin that coordinates cannot resolve the mesh.
Eigen::AlignedBox3d bounding_box(const SurfaceView& surface);

/// Returns the longest side of the bounding_box(), mesh units.
double longest_side(const SurfaceView& surface);

/// Returns the normal of the triangle abc; its length is twice the triangle's area.
inline Eigen::Vector3d twice_vector_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
    return (b - a).cross(c - a);
}
Eigen::Vector3d twice_vector_area(const SurfaceView& surface, const Triangle& triangle);

/// Returns whether a triangle's area is at most `ratio` times the square of its longest edge.
bool is_thin(const std::array<Eigen::Vector3d, 3>& corners, double ratio);

/// A triangle is degenerate if it is thin with this ratio. In double precision it has no plane
/// then.
inline constexpr double kDegenerate = 1e-12;

/// Returns the number of degenerate triangles.
std::int64_t count_degenerate(const SurfaceView& surface);

/// Returns the area of the selected triangles, in squared units of the mesh.
double surface_area(const SurfaceView& surface, const Selection& selection = {});

/// Returns the mean length of the sides of the selected triangles, in units of the mesh; 0 if there
/// are none.
double mean_edge_length(const SurfaceView& surface, const Selection& selection = {});

/// Returns the volume inside a closed mesh with consistently oriented triangles, in cubed units of
/// the mesh. The volume is negative if the triangles' normals point inwards.
double enclosed_volume(const SurfaceView& surface);

/// Returns the volume that a triangle sweeps when its corners move from `initial` to `present`
/// along straight lines, in cubed units of the mesh; positive along its normal. The sum over a
/// closed surface is the change of its enclosed volume.
double swept_volume(const std::array<Eigen::Vector3d, 3>& initial,
                    const std::array<Eigen::Vector3d, 3>& present);

/// Returns the rate at which swept_volume() grows when the corners move on at these velocities.
double swept_volume_rate(const std::array<Eigen::Vector3d, 3>& initial,
                         const std::array<Eigen::Vector3d, 3>& present,
                         const std::array<Eigen::Vector3d, 3>& velocities);

/// Returns the component of each vertex's vector along the vertex's normal, the mean of the normals
/// of its selected triangles, weighted by area. Coincident vertices of `surface` have one normal. 0
/// where no selected triangle has an area.
std::vector<double> along_normals(const std::vector<Eigen::Vector3d>& vectors,
                                  const SurfaceView& surface, const Selection& selection = {});

/// Returns how far each vertex has moved from `before` to `after`, along_normals() of the surface
/// after the movement.
std::vector<double> displacements_along_normals(const TriangleMesh& before,
                                                const std::vector<Eigen::Vector3d>& after,
                                                const Selection& selection);

/// Returns the positions of a triangle's corners.
inline std::array<Eigen::Vector3d, 3> corners_of(const std::vector<Eigen::Vector3d>& positions,
                                                 const Triangle& triangle) {
    return {positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]};
}

}  // namespace tracked_mcf
