// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/cells/clip.h"

#include <algorithm>

namespace tracked_mcf {

namespace {

/// Returns the point where the segment from a to b crosses a plane; a and b are on opposite sides.
/// The formula always starts at the lower point, so the result has the same bits on either side
/// of the plane, and for both triangles that share the edge.
inline Eigen::Vector3d cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis,
                           double plane) {
    const Eigen::Vector3d& below = a[axis] < b[axis] ? a : b;
    const Eigen::Vector3d& above = a[axis] < b[axis] ? b : a;
    const double fraction = (plane - below[axis]) / (above[axis] - below[axis]);
    Eigen::Vector3d point = below + fraction * (above - below);
    point[axis] = plane;
    return point;
}

}  // namespace

Polygon& Polygon::operator=(const Polygon& other) {
    size = other.size;
    std::copy_n(other.points.begin(), size, points.begin());
    corner = other.corner;
    edge = other.edge;
    return *this;
}

Polygon whole_triangle(const std::array<Eigen::Vector3d, 3>& corners) {
    Polygon polygon;
    for (int i = 0; i < 3; ++i) polygon.add(corners[i], i, i);
    return polygon;
}

/// Sutherland and Hodgman's algorithm for both planes at once: every point is cut from the
/// polygon's own points. Points in a plane are never cut again.
void cut_to_slab(const Polygon& polygon, int axis, std::int32_t slab, Polygon& part) {
    const double lower = slab, upper = slab + 1.0;
    part.size = 0;
    for (int i = 0; i < polygon.size; ++i) {
        const Eigen::Vector3d& point = polygon.points[i];
        const Eigen::Vector3d& next = polygon.points[polygon.next(i)];
        const double here = point[axis], there = next[axis];
        // The side that follows a point where the polygon leaves the slab lies in a plane.
        if (here >= lower && here <= upper) {
            const bool leaves =
                (here == lower && there < lower) || (here == upper && there > upper);
            part.add(point, polygon.corner[i], leaves ? Polygon::kNone : polygon.edge[i]);
        }
        const auto add_cut = [&](double plane, bool leaves) {
            if ((here < plane && plane < there) || (there < plane && plane < here)) {
                part.add(cut(point, next, axis, plane), Polygon::kNone,
                         leaves ? Polygon::kNone : polygon.edge[i]);
            }
        };
        const bool rises = here < there;
        add_cut(rises ? lower : upper, false);
        add_cut(rises ? upper : lower, true);
    }
}

Polygon clip_to_cell(const std::array<Eigen::Vector3d, 3>& corners, const Cell& cell) {
    const Polygon triangle = whole_triangle(corners);
    Polygon part_x, part_xy, part_xyz;
    const Extent along_x = extent_along(triangle, 0);
    const Polygon& in_x = clip_to_slab(triangle, along_x, 0, cell[0], part_x);
    const Extent along_y = extent_along(in_x, 1);
    const Polygon& in_xy = clip_to_slab(in_x, along_y, 1, cell[1], part_xy);
    const Extent along_z = extent_along(in_xy, 2);
    return clip_to_slab(in_xy, along_z, 2, cell[2], part_xyz);
}

}  // namespace tracked_mcf
