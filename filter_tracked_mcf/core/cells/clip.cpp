// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/cells/clip.h"

#include <algorithm>

namespace tracked_mcf {

namespace {

/// The side of a plane that is kept.
enum class Keep { Above, Below };

/// Returns the point where the segment from a to b crosses a plane; a and b are on opposite sides.
/// The formula always starts at the lower point, so the result has the same bits when clipping to
/// either side, and for both triangles that share the edge.
inline Eigen::Vector3d cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis,
                           double plane) {
    const Eigen::Vector3d& below = a[axis] < b[axis] ? a : b;
    const Eigen::Vector3d& above = a[axis] < b[axis] ? b : a;
    const double fraction = (plane - below[axis]) / (above[axis] - below[axis]);
    Eigen::Vector3d point = below + fraction * (above - below);
    point[axis] = plane;
    return point;
}

/// Clips to one side of a plane: Sutherland and Hodgman's algorithm. Points in the plane belong to
/// both sides and are never cut again.
template <Keep keep>
void clip_to_half_space(const Polygon& polygon, int axis, double plane, Polygon& kept) {
    const auto height = [&](int i) {
        const double above = polygon.points[i][axis] - plane;
        return keep == Keep::Above ? above : -above;
    };
    kept.size = 0;
    const double first = height(0);
    double here = first;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = polygon.next(i);
        const double there = next == 0 ? first : height(next);
        if (here >= 0) {
            const bool leaves_along_plane = here == 0 && there < 0;
            kept.add(polygon.points[i], polygon.corner[i],
                     leaves_along_plane ? Polygon::kNone : polygon.edge[i]);
        }
        if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
            kept.add(cut(polygon.points[i], polygon.points[next], axis, plane), Polygon::kNone,
                     here > 0 ? Polygon::kNone : polygon.edge[i]);
        }
        here = there;
    }
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

void cut_to_slab(const Polygon& polygon, const Extent& extent, int axis, std::int32_t slab,
                 Polygon& part) {
    const double lower = slab;
    const double upper = slab + 1.0;
    if (extent.largest <= upper) {
        clip_to_half_space<Keep::Above>(polygon, axis, lower, part);
    } else if (extent.smallest >= lower) {
        clip_to_half_space<Keep::Below>(polygon, axis, upper, part);
    } else {
        Polygon above;
        clip_to_half_space<Keep::Above>(polygon, axis, lower, above);
        clip_to_half_space<Keep::Below>(above, axis, upper, part);
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
