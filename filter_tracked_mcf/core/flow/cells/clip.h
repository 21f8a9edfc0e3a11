// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

#include "filter_tracked_mcf/core/mesh/grid.h"

namespace tracked_mcf {

/// A convex part of a triangle that remembers which of its points are corners of the triangle and
/// which of its sides lie on the triangle's sides.
struct Polygon {
    /// Three corners and one more for each of a cell's six planes need nine. The rest is for
    /// polygons so thin that rounding makes them cross a plane twice.
    static constexpr int kCapacity = 16;
    static constexpr int kNone = -1;

    int size = 0;
    std::array<Eigen::Vector3d, kCapacity> points;  ///< in order, grid coordinates
    /// Per point: the triangle's corner (0 to 2) that it is, or kNone if a cut made it.
    std::array<std::int8_t, kCapacity> corner;
    /// Per point: the triangle's side on which the polygon's side to the next point lies, or kNone
    /// if a cut made that side.
    std::array<std::int8_t, kCapacity> edge;

    // Copies only the points in use: the capacity is much larger than most polygons.
    Polygon() = default;
    Polygon(const Polygon& other) { *this = other; }
    Polygon& operator=(const Polygon& other);
    ~Polygon() = default;

    int next(int point) const { return point + 1 < size ? point + 1 : 0; }
    void add(const Eigen::Vector3d& point, int from_corner, int on_edge) {
        if (size == kCapacity) return;  // the polygon is a sliver of rounding error, without area
        points[size] = point;
        corner[size] = static_cast<std::int8_t>(from_corner);
        edge[size] = static_cast<std::int8_t>(on_edge);
        ++size;
    }
};

/// Returns a triangle as a polygon.
Polygon whole_triangle(const std::array<Eigen::Vector3d, 3>& corners);

/// The interval that a polygon covers along an axis.
struct Extent {
    double smallest, largest;
};
inline Extent extent_along(const Polygon& polygon, int axis) {
    Extent extent{polygon.points[0][axis], polygon.points[0][axis]};
    for (int i = 1; i < polygon.size; ++i) {
        extent.smallest = std::min(extent.smallest, polygon.points[i][axis]);
        extent.largest = std::max(extent.largest, polygon.points[i][axis]);
    }
    return extent;
}

/// Sets `part` to the part of a polygon between the planes `slab` and `slab + 1` of an axis, both
/// included.
void cut_to_slab(const Polygon& polygon, int axis, std::int32_t slab, Polygon& part);

/// Returns the part of a polygon between the planes `slab` and `slab + 1` of an axis. The result
/// refers to the polygon itself if it lies in the slab, else to `part`. `extent` is the polygon's
/// extent along the axis. Cut points lie exactly in their plane and have the same bits in the slabs
/// on either side, so the parts fit together without gaps or overlaps.
inline const Polygon& clip_to_slab(const Polygon& polygon, const Extent& extent, int axis,
                                   std::int32_t slab, Polygon& part) {
    if (extent.smallest >= slab && extent.largest <= slab + 1.0) return polygon;
    cut_to_slab(polygon, axis, slab, part);
    return part;
}

/// The slabs of an axis, first to last, both included and in [0, cells_per_side), that a polygon
/// meets in more than a touch. A polygon in a grid plane belongs to the slab above the plane.
struct SlabRange {
    std::int32_t first, last;
};
inline SlabRange slabs_met(const Extent& extent, std::int32_t cells_per_side) {
    // The casts round towards zero. This differs from rounding down only for negative numbers,
    // which are clamped to 0.
    const auto first = static_cast<std::int32_t>(extent.smallest);
    auto last = static_cast<std::int32_t>(extent.largest);
    if (last == extent.largest) --last;
    const std::int32_t top = cells_per_side - 1;
    return {std::clamp(first, 0, top), std::clamp(std::max(first, last), 0, top)};
}

/// Returns the part of a triangle in a cell. The bits are those that for_each_fragment gives, since
/// both clip to the cell's x slab, then to its y slab, then to its z slab.
Polygon clip_to_cell(const std::array<Eigen::Vector3d, 3>& corners, const Cell& cell);

/// Calls visit(cell, polygon) for every cell that the triangle meets, in increasing x, then y, then
/// z. The polygons are the triangle's fragments; their areas add up to the triangle's.
template <class Visit>
void for_each_fragment(const std::array<Eigen::Vector3d, 3>& corners, std::int32_t cells_per_side,
                       Visit&& visit) {
    const Polygon triangle = whole_triangle(corners);
    Polygon part_x, part_xy, part_xyz;
    const Extent along_x = extent_along(triangle, 0);
    const SlabRange xs = slabs_met(along_x, cells_per_side);
    for (std::int32_t x = xs.first; x <= xs.last; ++x) {
        const Polygon& in_x = clip_to_slab(triangle, along_x, 0, x, part_x);
        const Extent along_y = extent_along(in_x, 1);
        const SlabRange ys = slabs_met(along_y, cells_per_side);
        for (std::int32_t y = ys.first; y <= ys.last; ++y) {
            const Polygon& in_xy = clip_to_slab(in_x, along_y, 1, y, part_xy);
            const Extent along_z = extent_along(in_xy, 2);
            const SlabRange zs = slabs_met(along_z, cells_per_side);
            for (std::int32_t z = zs.first; z <= zs.last; ++z) {
                visit(Cell(x, y, z), clip_to_slab(in_xy, along_z, 2, z, part_xyz));
            }
        }
    }
}

}  // namespace tracked_mcf
