// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace tracked_mcf {

/// A cell of a grid, or a corner of cells: the grid coordinates of the cell's smallest corner.
using Cell = Eigen::Matrix<std::int32_t, 3, 1>;

/// The regular grid of the finest level: a cube of 2^depth cells a side. In *grid coordinates* the
/// cube is [0, 2^depth]³ and a finest cell has side 1. All computations use grid coordinates, so
/// they do not depend on the mesh's units.
struct Grid {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< smallest corner of the cube, mesh units
    double cell_size = 1;                              ///< side of a finest cell, mesh units
    int depth = 0;

    std::int32_t cells_per_side() const { return std::int32_t{1} << depth; }
    Eigen::Vector3d to_grid(const Eigen::Vector3d& position) const {
        return (position - origin) / cell_size;
    }
};

/// Returns the grid whose cube has 1.1 times the longest side of a box, and the same centre.
Grid enclosing_grid(const Eigen::AlignedBox3d& box, int depth);

/// Returns a grid of one cell that encloses a box. It is not in the middle: planes of symmetry, on
/// which many vertices may lie, are not between the cells of any depth.
Grid cube_around(const Eigen::AlignedBox3d& box);

/// Returns a grid of the same cube with 2^depth cells a side.
Grid with_depth(const Grid& grid, int depth);

/// The position of a cell in the octree's depth-first order: the bits of its coordinates
/// interleaved, x lowest. The last three bits are the octant of the cell in its parent; the others
/// are the parent's code.
using MortonCode = std::uint64_t;

/// Moves bit i of a number to bit 3 i, for the 21 lowest bits.
inline std::uint64_t spread_bits(std::uint64_t value) {
    value &= 0x1fffffU;
    value = (value | value << 32U) & 0x1f00000000ffffU;
    value = (value | value << 16U) & 0x1f0000ff0000ffU;
    value = (value | value << 8U) & 0x100f00f00f00f00fU;
    value = (value | value << 4U) & 0x10c30c30c30c30c3U;
    value = (value | value << 2U) & 0x1249249249249249U;
    return value;
}

/// Moves bit 3 i of a number to bit i: the inverse of spread_bits.
inline std::uint64_t gather_bits(std::uint64_t value) {
    value &= 0x1249249249249249U;
    value = (value | value >> 2U) & 0x10c30c30c30c30c3U;
    value = (value | value >> 4U) & 0x100f00f00f00f00fU;
    value = (value | value >> 8U) & 0x1f0000ff0000ffU;
    value = (value | value >> 16U) & 0x1f00000000ffffU;
    value = (value | value >> 32U) & 0x1fffffU;
    return value;
}

inline MortonCode morton_code(const Cell& cell) {
    return spread_bits(static_cast<std::uint64_t>(cell[0])) |
           spread_bits(static_cast<std::uint64_t>(cell[1])) << 1U |
           spread_bits(static_cast<std::uint64_t>(cell[2])) << 2U;
}

inline Cell cell_at(MortonCode code) {
    return {static_cast<std::int32_t>(gather_bits(code)),
            static_cast<std::int32_t>(gather_bits(code >> 1U)),
            static_cast<std::int32_t>(gather_bits(code >> 2U))};
}

inline MortonCode parent_of(MortonCode code) {
    return code >> 3U;
}
inline int octant_of(MortonCode code) {
    return static_cast<int>(code & 7U);
}

}  // namespace tracked_mcf
