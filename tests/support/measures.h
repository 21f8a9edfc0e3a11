// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the bounding box of the vertices that triangles use.
inline Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) box.extend(mesh.positions[vertex]);
    }
    return box;
}

/// Returns the longest side of the bounding_box().
inline double longest_side(const TriangleMesh& mesh) {
    return bounding_box(mesh).sizes().maxCoeff();
}

/// Returns the normal of a triangle; its length is twice the triangle's area.
inline Eigen::Vector3d twice_vector_area(const TriangleMesh& mesh, const Triangle& t) {
    return twice_vector_area(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

inline double surface_area(const TriangleMesh& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles) twice += twice_vector_area(mesh, t).norm();
    return twice / 2;
}

/// Returns the volume inside a closed mesh, relative to a vertex, so that a mesh far from the
/// origin loses no digits. It is negative if the normals point inwards.
inline double enclosed_volume(const TriangleMesh& mesh) {
    const Eigen::Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    double six_times = 0;
    for (const Triangle& t : mesh.triangles)
        six_times += (mesh.positions[t[0]] - near).dot(twice_vector_area(mesh, t));
    return six_times / 6;
}

}  // namespace tracked_mcf
