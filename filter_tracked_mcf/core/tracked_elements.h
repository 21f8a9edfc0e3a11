#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/samples.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A point at which the surface is held, on the piece of a held edge in one element.
struct HeldSample {
    std::int32_t element;
    Eigen::Vector3f local;     ///< local coordinates in its cell
    Eigen::Vector3f conormal;  ///< unit vector in the triangle's plane, square to the edge, outward
    float weight;              ///< length it stands for on the initial surface, grid units
};

/// Where a vertex lies: a finest element and local coordinates in its cell. Vertices that no
/// triangle uses have element kNowhere.
struct VertexPlace {
    static constexpr std::int32_t kNowhere = -1;
    std::int32_t element = kNowhere;
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
};

/// Coefficients of a map from the surface to space, one row per unknown of the finest level.
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Everything that is computed once, from the initial surface, and tracked from then on (section
/// 4.1): the octree, the test functions pulled back to the mesh, and the samples. Immutable during
/// the flow. All lengths are in grid units.
struct TrackedElements {
    Grid grid;
    std::vector<Level> levels;  ///< coarsest first

    RawVector<Fragment> fragments;             ///< sorted by finest element
    Samples samples;                           ///< sorted by fragment
    std::vector<std::int64_t> fragment_begin;  ///< of every finest element, and the end
    std::vector<std::int64_t> sample_begin;    ///< of every finest element, and the end

    RawVector<VertexPlace> vertices;        ///< of every vertex; coincident vertices share theirs
    std::vector<std::uint8_t> vertex_held;  ///< of every vertex: it keeps its bits
    std::vector<std::uint8_t> held;         ///< of every finest element: a held edge meets it
    std::vector<HeldSample> held_samples;   ///< sorted by finest element

    std::int64_t split_triangle_count = 0;
    std::int64_t fragment_count = 0;  ///< of triangles that are not degenerate
    std::int64_t referenced_vertex_count = 0;
    std::int64_t held_vertex_count = 0;          ///< of those
    std::int64_t degenerate_triangle_count = 0;  ///< see is_degenerate

    const Level& finest() const { return levels.back(); }
};

/// Clips the domain's surface to the grid, builds the octree over it and places samples and
/// vertices; see FlowParameters for the rest. Throws InvalidMesh if all triangles are degenerate or
/// a vertex lies outside the grid's cube.
TrackedElements build_tracked_elements(const Domain& domain, const Grid& grid, Cubature cubature,
                                       bool separate_sheets = true);

/// The same for a domain's surface that is clipped already.
TrackedElements build_tracked_elements(const Domain& domain, ClippedSurface surface,
                                       Cubature cubature, bool separate_sheets = true);

/// The same for all of a mesh with its boundary held.
TrackedElements build_tracked_elements(const TriangleMesh& mesh, const Grid& grid,
                                       Cubature cubature, bool separate_sheets = true);

/// Coefficients of the identity, Σ (i, j, k) B_ijk(p) = p (section 5.3): of every unknown of the
/// finest level its corner, grid coordinates.
Coefficients identity_coefficients(const TrackedElements& elements);

/// EvaluateVertex (section 4.3): the map with these coefficients at a vertex that is somewhere.
Eigen::Vector3d evaluate_vertex(const TrackedElements& elements, const Coefficients& coefficients,
                                const VertexPlace& vertex);

}  // namespace tracked_mcf
