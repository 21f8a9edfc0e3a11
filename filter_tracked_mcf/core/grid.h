#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The finest level's regular grid: a cube of 2^depth cells a side. In *grid coordinates* the cube
/// is [0, 2^depth]³ and a finest cell has side 1; all the mathematics is done there, where every
/// number is of order one whatever the mesh's units.
struct Grid {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< smallest corner of the cube, mesh units
    double cell_size = 1;                              ///< side of a finest cell, mesh units
    int depth = 0;

    std::int32_t cells_per_side() const { return std::int32_t{1} << depth; }
    Eigen::Vector3d to_grid(const Eigen::Vector3d& position) const {
        return (position - origin) / cell_size;
    }
};

/// Longest side of the bounding box of the referenced vertices, mesh units. Throws InvalidMesh if
/// it is zero, too large or too small for the arithmetic of doubles, or lost beside the mesh's
/// distance from the origin.
double longest_side(const TriangleMesh& mesh);

/// The grid whose cube has 1.1 times the longest side of the mesh's bounding box (referenced
/// vertices only) and the same centre.
Grid enclosing_grid(const TriangleMesh& mesh, int depth);

/// The same cube with 2^depth cells a side.
Grid with_depth(const Grid& grid, int depth);

}  // namespace tracked_mcf
