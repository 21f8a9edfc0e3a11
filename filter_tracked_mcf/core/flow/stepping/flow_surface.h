// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/grid.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/stars.h"

namespace tracked_mcf {

/// The surface of a domain by itself, as a flow moves it. Its vertices are those that its triangles
/// use, coincident ones once, in the order of space: neighbours in space are neighbours in memory.
struct FlowSurface {
    Stars stars;
    std::vector<Eigen::Vector3d> positions;  ///< in edges, around the origin
    std::vector<std::uint8_t> fixed;         ///< per vertex: whether it stays
    std::vector<float> densities;            ///< per triangle of the stars; empty if all are 1
    std::vector<std::int32_t> components;    ///< per vertex: its connected component
    std::int32_t component_count = 0;
    std::int64_t constrained_count = 0;  ///< vertices that stay
    double edge = 1;                     ///< mean length of the sides of triangles, mesh units
    std::vector<std::int32_t> vertices;  ///< of the mesh: the surface's vertex, or -1
};

/// Returns a grid of one cell that encloses a box. It is not in the middle: planes of symmetry, on
/// which many vertices may lie, are not between the cells of any depth.
Grid cube_around(const Eigen::AlignedBox3d& box);

/// Returns the surface of a domain. `densities` are those of the domain's triangles; none if all
/// are 1. At least one triangle has an area.
FlowSurface flow_surface_of(const Domain& domain, const std::vector<double>& densities);

}  // namespace tracked_mcf
