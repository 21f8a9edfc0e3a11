// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// One vector per vertex. The fourth component is 0, and makes arithmetic four wide.
using Vectors = RawVector<Eigen::Vector4f>;

/// A surface as noise is removed from it. Lengths are in edges.
struct NoisySurface {
    Stars stars;
    Positions positions;
    /// Per vertex: how much more than others it keeps its position; 0 if it is held.
    std::vector<float> fidelity;

    bool is_held(std::int32_t vertex) const { return fidelity[vertex] == 0; }
};

/// Returns the fidelities of a surface's vertices, which follow from their strengths.
std::vector<float> fidelities_of(const Surface& surface);

/// Returns the box that no vertex may leave: that of the positions, a tenth of its diagonal larger
/// on each side.
Eigen::AlignedBox3d confinement(const Positions& positions);

/// Some regions of a surface, without the strengths of its vertices.
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

/// Returns regions of `region` vertices that are spread over the surface and have about so many
/// vertices together; all of a surface that is not much larger. Neither the regions nor the signs
/// depend on the order of the vertices. Nor do they depend on the surface's place in space, but for
/// rounding. An exception are vertices at the same distance from the middle: their coordinates
/// decide.
Sample sample_of(const NoisySurface& surface, std::int32_t vertex_count,
                 const std::vector<float>& fidelities = {}, std::int32_t region = 500);

}  // namespace tracked_mcf
