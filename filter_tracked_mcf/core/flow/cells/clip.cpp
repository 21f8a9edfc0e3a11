// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/clip.h"

#include <algorithm>

namespace tracked_mcf {

namespace {

/// Adds the point where the segment from a to b crosses a plane; a and b are on opposite sides. The
/// formula always starts at the lower point, so the result has the same bits on either side of the
/// plane, and for both triangles that share the edge.
inline void add_cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis, double plane,
                    int on_edge, Polygon& part) {
    const Eigen::Vector3d& below = a[axis] < b[axis] ? a : b;
    const Eigen::Vector3d& above = a[axis] < b[axis] ? b : a;
    const double fraction = (plane - below[axis]) / (above[axis] - below[axis]);
    Eigen::Vector3d cut = below + fraction * (above - below);
    cut[axis] = plane;
    part.add(cut, Polygon::kNone, on_edge);
}

}  // namespace

Polygon& Polygon::operator=(const Polygon& other) {
    size = other.size;
    std::copy_n(other.points.begin(), size, points.begin());
    std::copy_n(other.corner.begin(), size, corner.begin());
    std::copy_n(other.edge.begin(), size, edge.begin());
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
    // -1 below the slab, 0 in it, 1 above
    const auto side_of = [&](double height) {
        return static_cast<int>(height > upper) - static_cast<int>(height < lower);
    };
    const auto plane_of = [&](int side) { return side < 0 ? lower : upper; };
    part.size = 0;
    double here = polygon.points[0][axis];
    int side = side_of(here);
    for (int i = 0; i < polygon.size; ++i) {
        const Eigen::Vector3d& point = polygon.points[i];
        const Eigen::Vector3d& next = polygon.points[polygon.next(i)];
        const double there = next[axis];
        const int next_side = side_of(there);
        const bool enters = side != 0 && side != next_side && there != plane_of(side);
        const bool leaves = next_side != 0 && side != next_side;
        const bool leaves_from_plane = leaves && here == plane_of(next_side);
        // The side that follows a point where the polygon leaves the slab lies in a plane.
        if (side == 0) {
            part.add(point, polygon.corner[i],
                     leaves_from_plane ? Polygon::kNone : polygon.edge[i]);
        }
        if (enters) {
            add_cut(point, next, axis, plane_of(side), polygon.edge[i], part);
        }
        if (leaves && !leaves_from_plane) {
            add_cut(point, next, axis, plane_of(next_side), Polygon::kNone, part);
        }
        here = there;
        side = next_side;
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
