// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/fragments.h"
#include "filter_tracked_mcf/core/flow/elements/samples.h"
#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The location of a vertex: a finest element and local coordinates in its cell.
struct VertexLocation {
    static constexpr std::int32_t kNoElement = -1;  ///< of vertices that no triangle uses
    std::int32_t element = kNoElement;
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
};

/// Coefficients of a map from the surface to space, one row per unknown of the finest level.
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Everything that is computed once from the initial surface and then tracked (section 4.1): the
/// octree, the test functions pulled back to the mesh, and the samples. It does not change during
/// the flow. All lengths are in grid units.
struct TrackedElements {
    Grid grid;
    std::vector<Level> levels;  ///< coarsest first

    RawVector<Fragment> fragments;             ///< sorted by finest element
    Samples samples;                           ///< sorted by fragment
    std::vector<std::int64_t> fragment_begin;  ///< per finest element, and the end
    std::vector<std::int64_t> sample_begin;    ///< per finest element, and the end

    RawVector<VertexLocation> vertices;         ///< of the mesh, equal for coincident vertices
    std::vector<std::uint8_t> vertex_held;      ///< per vertex: whether it keeps its bits
    std::vector<std::uint8_t> meets_held_side;  ///< per finest element

    std::int64_t split_triangle_count = 0;
    std::int64_t fragment_count = 0;  ///< without fragments of degenerate triangles

    const Level& finest() const { return levels.back(); }
};

/// Builds the octree over a clipped surface, and computes its samples and the locations of the
/// mesh's vertices. Throws InvalidMesh if all triangles are degenerate.
TrackedElements build_tracked_elements(const Surface& surface, ClippedSurface clipped,
                                       Cubature cubature);

/// Returns the map with these coefficients at a vertex that has an element: the paper's
/// EvaluateVertex (section 4.3).
Eigen::Vector3d evaluate_vertex(const TrackedElements& elements, const Coefficients& coefficients,
                                const VertexLocation& vertex);

/// Adds the map with these coefficients, in mesh units, to `vectors`, one for each vertex of the
/// mesh. Leaves those of vertices that do not move, or that the map takes to zero, as they are.
void add_at_vertices(const TrackedElements& elements, const Coefficients& coefficients,
                     std::vector<Eigen::Vector3d>& vectors);

}  // namespace tracked_mcf
