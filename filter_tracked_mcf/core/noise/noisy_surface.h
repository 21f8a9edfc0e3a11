// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/stars.h"

namespace tracked_mcf {

/// Positions of a surface's vertices, in edges: mean lengths of its sides.
using Positions = std::vector<Eigen::Vector3d>;

/// One vector per vertex. The fourth component is 0, and makes arithmetic four wide.
using Vectors = RawVector<Eigen::Vector4f>;

/// A surface as noise is removed from it. Its vertices are those that its triangles use, coincident
/// ones once. Its lengths are in edges.
struct NoisySurface {
    Stars stars;  ///< of triangles that are oriented alike
    Positions positions;
    /// Per vertex: how much more than others it keeps its position; 0 if it keeps its bits.
    std::vector<float> fidelity;

    bool is_fixed(std::int32_t vertex) const { return fidelity[vertex] == 0; }
};

/// A surface, and the way back from it to the mesh.
struct SurfaceOfMesh {
    NoisySurface surface;                ///< around the origin
    std::vector<std::int32_t> vertices;  ///< of the mesh: the surface's vertex, or -1
    double edge = 0;  ///< mean length, mesh units; rounded, so that it is the same in any order
};

/// Returns the surface of a domain. A triangle of it must have an area.
SurfaceOfMesh surface_of(const Domain& domain);

/// Returns the box that no vertex may leave: that of the positions, a tenth of its diagonal larger
/// on each side.
Eigen::AlignedBox3d confinement(const Positions& positions);

/// Part of a surface, without the strengths of its vertices.
struct Sample {
    NoisySurface surface;
    /// Per vertex: whether the sample has all of its star and of its neighbours' stars, and it may
    /// move. Beside the border of a sample, a candidate does less than inside.
    std::vector<std::uint8_t> counts;
    std::vector<float> signs;  ///< per vertex: 1 or -1, at random
};

/// Returns the vertices in an order that does not depend on their numbers.
std::vector<std::int32_t> in_rank(const Positions& positions);

/// Returns a sign for each vertex, 1 or -1, at random, which does not depend on their order.
std::vector<float> random_signs(const Positions& positions);

/// Returns patches of `patch` vertices that are spread over the surface and have about so many
/// vertices together; all of a surface that is not much larger. Neither the patches nor the signs
/// depend on the order of the vertices. Nor do they depend on the surface's place in space, but for
/// rounding. An exception are vertices at the same distance from the middle: their coordinates
/// decide.
Sample sample_of(const NoisySurface& surface, std::int32_t vertex_count,
                 const std::vector<float>& fidelities = {}, std::int32_t patch = 500);

}  // namespace tracked_mcf
