// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "filter_tracked_mcf/core/noise/parts.h"

namespace tracked_mcf {

/// The lattice of voxels or slices. Points with whole coordinates are corners of cells if a label's
/// border consists of faces of cells, and middles of cells if marching cubes made it.
struct Lattice {
    Eigen::Matrix3d cell = Eigen::Matrix3d::Identity();  ///< columns: the sides of a cell, in edges
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< a point with whole coordinates
    bool is_marching = false;
    bool is_soft = false;  ///< whether cells were averaged before marching cubes
};

/// Returns the lattice whose cells a part is the border of, or none. Cells may be turned, sheared,
/// and of any proportions.
///
/// Positions prove a lattice. All vertices of faces of cells have whole coordinates. Those of
/// marching cubes have two whole ones and a half. Other surfaces with such coordinates are told by
/// their triangles: faces of cells are at right angles to a side, and no edge leaves a cell. If
/// cells were averaged or blurred, see soft_lattice.h.
std::optional<Lattice> lattice_of(const NoisySurface& surface, const PartRange& part);

/// Returns whether a part is the border of cells of this lattice.
bool is_border(const NoisySurface& surface, const PartRange& part, const Lattice& lattice);

/// Returns the side of the cells that a triangle is at right angles to, or 3 if there is none. The
/// corners are in cells.
std::size_t side_of(const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace tracked_mcf
