#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// How the triangles of a mesh hang together. Coincident vertices count as one, so that a triangle
/// soup is the mesh it came from.
struct MeshTopology {
    static constexpr std::int32_t kNoEdge = -1;

    std::vector<std::int32_t> welded;  ///< of every vertex, see weld_coincident_vertices
    RawVector<Triangle> triangles;     ///< their welded vertices
    /// Of every triangle and i: the edge that joins corner i and corner (i + 1) % 3, or kNoEdge if
    /// these are one vertex. Any number of triangles may have the same edge.
    RawVector<std::array<std::int32_t, 3>> edges;
    std::int32_t edge_count = 0;  ///< edges are numbered by their vertices, the smaller one first
};

/// The topology of a mesh that validate() accepts. Throws InvalidMesh if there are more than
/// 2147483647 edges.
MeshTopology topology_of(const TriangleMesh& mesh);

/// Number of different vertices that the triangles use.
std::int64_t count_vertices(const MeshTopology& topology);

/// For every triangle, bit i is set if its edge from corner i to corner (i + 1) % 3 is on the
/// boundary: no other triangle has that edge, copies of a triangle counting as one triangle.
/// Triangles with two equal vertices do not count at all.
std::vector<std::uint8_t> boundary_edges(const MeshTopology& topology);

/// Whether every edge is gone along as often in one direction as in the other by the triangles that
/// have it. Of a surface that is closed besides, that makes the enclosed volume well defined.
bool is_oriented_consistently(const MeshTopology& topology);

}  // namespace tracked_mcf
