#pragma once

#include <Eigen/Core>
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

inline void Polygon::add(const Eigen::Vector3d& point, int from_corner, int on_edge) {
    if (size == kCapacity) return;  // a sliver of rounding error: its area is nothing
    points[size] = point;
    corner[size] = static_cast<std::int8_t>(from_corner);
    edge[size] = static_cast<std::int8_t>(on_edge);
    ++size;
}

/// The polygon that is all of a triangle with these corners.
Polygon whole_triangle(const std::array<Eigen::Vector3d, 3>& corners);

/// The part of `polygon` between the planes `coordinate` and `coordinate + 1` of `axis`, both
/// included. Cut points lie exactly in their plane and are the same bits for the slabs on either
/// side, so the parts of a polygon fit together without gaps or overlaps.
Polygon clip_to_slab(const Polygon& polygon, int axis, std::int32_t coordinate);

/// The same without a copy: `polygon` itself if it lies in the slab, else `room`, where the part is
/// put. The two must be different.
const Polygon& clip_to_slab(const Polygon& polygon, int axis, std::int32_t coordinate,
                            Polygon& room);

/// Slabs of `axis` that a polygon meets in more than a touch: first to last, both included and in
/// [0, cells_per_side). A polygon that lies in a grid plane belongs to the slab above it.
struct SlabRange {
    std::int32_t first, last;
};
SlabRange slabs_met(const Polygon& polygon, int axis, std::int32_t cells_per_side);

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
    const SlabRange xs = slabs_met(triangle, 0, cells_per_side);
    for (std::int32_t x = xs.first; x <= xs.last; ++x) {
        const Polygon& in_x = clip_to_slab(triangle, 0, x, room_x);
        const SlabRange ys = slabs_met(in_x, 1, cells_per_side);
        for (std::int32_t y = ys.first; y <= ys.last; ++y) {
            const Polygon& in_xy = clip_to_slab(in_x, 1, y, room_xy);
            const SlabRange zs = slabs_met(in_xy, 2, cells_per_side);
            for (std::int32_t z = zs.first; z <= zs.last; ++z) {
                visit(Cell(x, y, z), clip_to_slab(in_xy, 2, z, room_xyz));
            }
        }
    }
}

/// Twice the vector area of a planar polygon: along its normal, twice as long as its area.
Eigen::Vector3d twice_vector_area(const Polygon& polygon);

}  // namespace tracked_mcf
