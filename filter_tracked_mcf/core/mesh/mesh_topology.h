// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The connectivity of a mesh. Coincident vertices count as one vertex, so a triangle soup has the
/// connectivity of the mesh it was made from. So do vertices on both sides of a narrow crack.
///
/// Side i of a triangle goes from its corner i to its corner (i + 1) % 3. Flags of a triangle's
/// sides are bits of one number: bit i belongs to side i.
struct MeshTopology {
    static constexpr std::int32_t kNoEdge = -1;

    std::vector<std::uint8_t> referenced;  ///< per vertex: 1 if a triangle has it, else 0
    std::vector<std::int32_t>
        welded;  ///< per vertex: its representative, see weld_coincident_vertices; close_cracks
    RawVector<Triangle> triangles;  ///< per triangle: its welded vertices
    /// Per triangle: the edge along each side, or kNoEdge if the side joins a vertex to itself. Any
    /// number of triangles may share an edge.
    RawVector<std::array<std::int32_t, 3>> edges;
    /// Edges are numbered in the order of their smaller vertex, then of their larger one.
    std::int32_t edge_count = 0;
    /// Per triangle: flags of the sides on the boundary. A side is on the boundary if no other
    /// triangle has its edge. Copies of a triangle count as one triangle. Triangles with two equal
    /// vertices do not count: they have no boundary sides and close no boundary.
    std::vector<std::uint8_t> boundary;
    CrackReport cracks;
    /// The largest difference, over all edges, between the numbers of triangles that pass along the
    /// edge in one and in the other direction.
    std::int32_t imbalance = 0;

    /// Returns whether the volume inside the surface is well defined.
    bool bounds_volume() const { return imbalance == 0; }
    bool is_oriented_consistently() const { return imbalance <= 1; }
};

/// Calls visit(triangle, side, edge) for all sides that are edges, in parallel for the triangles.
template <class Visit>
void for_each_edge(const MeshTopology& topology, const Visit& visit) {
    const auto count = static_cast<std::int64_t>(topology.edges.size());
    parallel_for_rows(count, [&](std::int32_t triangle) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge != MeshTopology::kNoEdge) visit(triangle, side, edge);
        }
    });
}

/// Returns whether a triangle's vertices differ.
constexpr bool has_three_vertices(const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// Returns whether bit `i` of a triangle's flags is set.
constexpr bool has_bit(std::uint64_t flags, int i) {
    return (flags >> static_cast<unsigned>(i) & 1U) != 0;
}

/// Returns the connectivity of a mesh that validate() accepts. Throws InvalidMesh if the mesh has
/// more than 2147483647 edges.
MeshTopology topology_of(const TriangleMesh& mesh);

/// Sets what depends on `triangles`: edges, edge_count, boundary, imbalance. Throws as
/// topology_of() does.
void find_edges(MeshTopology& topology);

/// Returns the number of different referenced vertices.
std::int64_t count_vertices(const MeshTopology& topology);

/// Returns flags: 1 for the first copy of each referenced vertex.
std::vector<std::uint8_t> one_copy_of_each_vertex(const MeshTopology& topology);

/// Returns the sum of the genus of all connected components: the number of their handles. 0 if an
/// edge has not exactly two triangles.
std::int64_t genus_of(const MeshTopology& topology);

}  // namespace tracked_mcf
