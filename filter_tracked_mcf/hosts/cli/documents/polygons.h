// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

using Points = std::vector<Eigen::Vector3d>;

/// The faces of a file, with any number of corners each: polygon i has the corners first[i] to
/// first[i + 1] - 1. Polygons of fewer than 3 corners have no triangles.
struct Polygons {
    std::vector<std::int32_t> corners;  ///< vertex indices
    std::vector<std::size_t> first{0};

    std::size_t size() const { return first.size() - 1; }
    std::size_t corner_count(std::size_t i) const { return first[i + 1] - first[i]; }
    std::size_t triangle_count(std::size_t i) const {
        return std::max<std::size_t>(corner_count(i), 2) - 2;
    }

    /// Returns the number of polygons that have triangles.
    std::size_t size_with_triangles() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < size(); ++i) count += corner_count(i) >= 3 ? 1 : 0;
        return count;
    }

    /// Ends a polygon: it has the corners added since the last call.
    void close() { first.push_back(corners.size()); }
};

/// Returns the triangles of all polygons in order; each polygon is a fan about its first corner.
std::vector<Triangle> fans(const Polygons& polygons);

/// Returns `count` unit normals of the shape `after`. Corner c contributes the area vector of its
/// polygon to normal normal_of_corner[c], or to none if that is -1. One normal per vertex gives
/// area-weighted vertex normals; a vertex with several normals keeps its crease sharp.
///
/// A normal is zero unless one of its polygons has an area and a vertex that has moved since
/// `before`. A triangle has no area if rounding to this relative precision may flatten it.
Points moved_normals(const Points& before, const Points& after, double precision,
                     const Polygons& polygons, const std::vector<std::int32_t>& normal_of_corner,
                     std::size_t count);

}  // namespace tracked_mcf
