#include "filter_tracked_mcf/core/clip.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tracked_mcf {

namespace {

/// Which side of the plane is kept.
enum class Keep { Above, Below };

/// Where the segment between two points on either side crosses the plane. The point below always
/// comes first, so that both sides of the plane, and both triangles of an edge, get the same bits.
inline Eigen::Vector3d cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int axis,
                           double plane) {
    const Eigen::Vector3d& below = a[axis] < b[axis] ? a : b;
    const Eigen::Vector3d& above = a[axis] < b[axis] ? b : a;
    const double fraction = (plane - below[axis]) / (above[axis] - below[axis]);
    Eigen::Vector3d point = below + fraction * (above - below);
    point[axis] = plane;
    return point;
}

/// Sutherland and Hodgman's step for one plane. Points in the plane are kept by both sides and
/// never cut again.
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
        const int next = i + 1 < polygon.size ? i + 1 : 0;
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

void cut_to_slab(const Polygon& polygon, const Extent& extent, int axis, std::int32_t coordinate,
                 Polygon& room) {
    const double lower = coordinate;
    const double upper = coordinate + 1.0;
    if (extent.largest <= upper) {
        clip_to_half_space<Keep::Above>(polygon, axis, lower, room);
    } else if (extent.smallest >= lower) {
        clip_to_half_space<Keep::Below>(polygon, axis, upper, room);
    } else {
        Polygon above;
        clip_to_half_space<Keep::Above>(polygon, axis, lower, above);
        clip_to_half_space<Keep::Below>(above, axis, upper, room);
    }
}

Polygon clip_to_slab(const Polygon& polygon, int axis, std::int32_t coordinate) {
    Polygon room;
    return clip_to_slab(polygon, extent_along(polygon, axis), axis, coordinate, room);
}

Polygon clip_to_cell(const std::array<Eigen::Vector3d, 3>& corners, const Cell& cell) {
    const Polygon triangle = whole_triangle(corners);
    Polygon room_x, room_xy, room_xyz;
    const Polygon& in_x = clip_to_slab(triangle, extent_along(triangle, 0), 0, cell[0], room_x);
    const Polygon& in_xy = clip_to_slab(in_x, extent_along(in_x, 1), 1, cell[1], room_xy);
    return clip_to_slab(in_xy, extent_along(in_xy, 2), 2, cell[2], room_xyz);
}

Eigen::Vector3d twice_vector_area(const Polygon& polygon) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 2; i < polygon.size; ++i) {
        sum += (polygon.points[i - 1] - polygon.points[0])
                   .cross(polygon.points[i] - polygon.points[0]);
    }
    return sum;
}

}  // namespace tracked_mcf
