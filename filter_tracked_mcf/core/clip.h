#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

namespace tracked_mcf {

/// A cell of a grid: its smallest corner in grid coordinates.
using Cell = Eigen::Matrix<std::int32_t, 3, 1>;

/// A convex polygon, part of a triangle, that remembers where it came from.
struct Polygon {
    /// Three corners and one more for each of a cell's six planes; the rest is for polygons so thin
    /// that rounding makes them cross a plane twice.
    static constexpr int kCapacity = 16;
    static constexpr int kNone = -1;

    int size = 0;
    std::array<Eigen::Vector3d, kCapacity> points;  ///< in order, grid coordinates
    /// Corner of the triangle (0 to 2) that point i is, or kNone for a cut.
    std::array<std::int8_t, kCapacity> corner;
    /// Edge of the triangle (e from corner e to (e + 1) % 3) in which the side from point i to the
    /// next lies, or kNone for a side that a cut made.
    std::array<std::int8_t, kCapacity> edge;

    // There is much room and little in it: only what is used is copied.
    Polygon() = default;
    Polygon(const Polygon& other) { *this = other; }
    Polygon& operator=(const Polygon& other);
    ~Polygon() = default;

    void add(const Eigen::Vector3d& point, int from_corner, int on_edge);
};

/// The polygon that is all of a triangle with these corners.
Polygon whole_triangle(const std::array<Eigen::Vector3d, 3>& corners);

/// From where to where a polygon reaches along an axis.
struct Extent {
    double smallest, largest;
};
Extent extent_along(const Polygon& polygon, int axis);

/// The part of `polygon` between the planes `coordinate` and `coordinate + 1` of `axis`, both
/// included. Cut points lie exactly in their plane and are the same bits for the slabs on either
/// side, so the parts of a polygon fit together without gaps or overlaps.
Polygon clip_to_slab(const Polygon& polygon, int axis, std::int32_t coordinate);

/// The same without a copy, given the polygon's extent: `polygon` itself if it lies in the slab,
/// else `room`, where the part is put. The two must be different.
const Polygon& clip_to_slab(const Polygon& polygon, Extent extent, int axis,
                            std::int32_t coordinate, Polygon& room);

/// Puts into `room` the part of a polygon of this extent that is in a slab.
void cut_to_slab(const Polygon& polygon, const Extent& extent, int axis, std::int32_t coordinate,
                 Polygon& room);

/// Slabs of an axis that a polygon of this extent meets in more than a touch: first to last, both
/// included and in [0, cells_per_side). A polygon that lies in a grid plane belongs to the slab
/// above it.
struct SlabRange {
    std::int32_t first, last;
};
SlabRange slabs_met(const Extent& extent, std::int32_t cells_per_side);

/// The part of a triangle in a cell: clipped to the cell's x, then y, then z slab, exactly as
/// for_each_fragment does, so with the same bits.
Polygon clip_to_cell(const std::array<Eigen::Vector3d, 3>& corners, const Cell& cell);

/// Calls visit(cell, polygon) for every cell that the triangle meets, in increasing x, then y, then
/// z: the triangle's fragments. Their areas add up to the triangle's.
template <class Visit>
void for_each_fragment(const std::array<Eigen::Vector3d, 3>& corners, std::int32_t cells_per_side,
                       Visit&& visit) {
    const Polygon triangle = whole_triangle(corners);
    Polygon room_x, room_xy, room_xyz;
    const Extent along_x = extent_along(triangle, 0);
    const SlabRange xs = slabs_met(along_x, cells_per_side);
    for (std::int32_t x = xs.first; x <= xs.last; ++x) {
        const Polygon& in_x = clip_to_slab(triangle, along_x, 0, x, room_x);
        const Extent along_y = extent_along(in_x, 1);
        const SlabRange ys = slabs_met(along_y, cells_per_side);
        for (std::int32_t y = ys.first; y <= ys.last; ++y) {
            const Polygon& in_xy = clip_to_slab(in_x, along_y, 1, y, room_xy);
            const Extent along_z = extent_along(in_xy, 2);
            const SlabRange zs = slabs_met(along_z, cells_per_side);
            for (std::int32_t z = zs.first; z <= zs.last; ++z) {
                visit(Cell(x, y, z), clip_to_slab(in_xy, along_z, 2, z, room_xyz));
            }
        }
    }
}

/// Twice the vector area of a planar polygon: along its normal, twice as long as its area.
Eigen::Vector3d twice_vector_area(const Polygon& polygon);

inline Extent extent_along(const Polygon& polygon, int axis) {
    Extent extent{polygon.points[0][axis], polygon.points[0][axis]};
    for (int i = 1; i < polygon.size; ++i) {
        extent.smallest = std::min(extent.smallest, polygon.points[i][axis]);
        extent.largest = std::max(extent.largest, polygon.points[i][axis]);
    }
    return extent;
}

inline const Polygon& clip_to_slab(const Polygon& polygon, Extent extent, int axis,
                                   std::int32_t coordinate, Polygon& room) {
    if (extent.smallest >= coordinate && extent.largest <= coordinate + 1.0) return polygon;
    cut_to_slab(polygon, extent, axis, coordinate, room);
    return room;
}

inline SlabRange slabs_met(const Extent& extent, std::int32_t cells_per_side) {
    // Towards zero is down, or to where the range ends anyway.
    const auto first = static_cast<std::int32_t>(extent.smallest);
    auto last = static_cast<std::int32_t>(extent.largest);
    if (last == extent.largest) --last;
    const std::int32_t top = cells_per_side - 1;
    return {std::clamp(first, 0, top), std::clamp(std::max(first, last), 0, top)};
}

inline void Polygon::add(const Eigen::Vector3d& point, int from_corner, int on_edge) {
    if (size == kCapacity) return;  // a sliver of rounding error: its area is nothing
    points[size] = point;
    corner[size] = static_cast<std::int8_t>(from_corner);
    edge[size] = static_cast<std::int8_t>(on_edge);
    ++size;
}

}  // namespace tracked_mcf
