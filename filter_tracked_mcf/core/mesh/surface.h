// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// How many of a mesh's triangles became a surface, and what its edges are.
struct SurfaceCounts {
    std::int64_t triangles = 0;      ///< of the mesh, those that may move
    std::int64_t zero_strength = 0;  ///< of the others: selected, but all vertices have strength 0
    std::int64_t unselected = 0;     ///< the rest of the mesh
    std::int64_t degenerate = 0;     ///< of `triangles`: without an area; see surface_of()
    std::int64_t copies = 0;         ///< of `triangles`: others have the same three vertices
    std::int64_t double_sided_parts = 0;  ///< the mesh has most of their area in both directions
    std::int64_t boundary_edges = 0;      ///< on the rim of the mesh
    CrackReport cracks;
};

/// The faces of a mesh that a filter may move, as a surface by itself.
///
/// Coincident vertices are one vertex, and so are those on both sides of a narrow crack. Triangles
/// have three different vertices. Copies of a triangle, in either direction, are one triangle with
/// the direction of most of them. The triangles of a part, a connected component, are oriented
/// alike as most of its area is, where that is possible; see Stars::imbalance.
///
/// Vertices are numbered part by part, and along Morton's curve within a part; triangles begin at
/// their least vertex and are sorted. So neighbours in space are neighbours in memory, and neither
/// the surface nor what is computed from it depends on the order of the mesh's vertices and faces,
/// except where the strengths of a vertex's copies differ.
struct Surface {
    Stars stars;
    Positions positions;              ///< in edges, around the origin
    std::vector<std::uint8_t> held;   ///< per vertex: whether it keeps its bits
    std::vector<double> strengths;    ///< per vertex, see Inputs::strength; empty if all are 1
    std::vector<std::int32_t> parts;  ///< per vertex: the number of its part, which increases
    std::int32_t part_count = 0;
    /// Per triangle, flags of the held sides: bit i of side i. A side is held if it is on the rim
    /// and that is not free, if a triangle outside the surface has it, too, or if slivers pass this
    /// on, see hold_vertices(). Empty if nothing is held by its side.
    std::vector<std::uint8_t> held_sides;

    double edge = 1;          ///< mean length of the sides of the triangles, mesh units
    Eigen::AlignedBox3d box;  ///< of the vertices, mesh units; its centre is at the origin
    std::vector<std::int32_t> vertices;       ///< per vertex of the mesh: the surface's, or -1
    std::vector<std::int32_t> mesh_vertices;  ///< per vertex: a vertex of the mesh at its place
    SurfaceCounts counts;

    /// Returns the position of a vertex in edges: as `positions` has it from the beginning.
    Eigen::Vector3d in_edges(const TriangleMesh& mesh, std::int32_t vertex) const {
        return (in_mesh_units(mesh, vertex) - box.center()) / edge;
    }
    /// Returns the position of a vertex in mesh units.
    const Eigen::Vector3d& in_mesh_units(const TriangleMesh& mesh, std::int32_t vertex) const {
        return mesh.positions[mesh_vertices[vertex]];
    }
    /// Returns those of all vertices.
    Positions in_mesh_units(const TriangleMesh& mesh) const;
    /// Returns a triangle as vertices of the mesh.
    Triangle mesh_triangle(std::int64_t triangle) const {
        const Triangle& t = stars.triangles[triangle];
        return {mesh_vertices[t[0]], mesh_vertices[t[1]], mesh_vertices[t[2]]};
    }
    bool has_held_vertices() const;
    bool is_oriented_alike() const { return stars.imbalance <= 1; }
    /// Returns whether the volume inside is well defined: no side is on a rim, then.
    bool bounds_volume() const { return stars.imbalance == 0; }
    bool is_whole_mesh() const { return counts.unselected + counts.zero_strength == 0; }
    /// Returns the sum of the genus of all parts: the number of their handles. 0 if an edge has not
    /// exactly two triangles.
    std::int64_t genus() const;
};

/// Returns the surface of all triangles of a mesh that validate() accepts. No vertex is held. Of
/// degenerate triangles, only those without three vertices are counted. Throws InvalidMesh as
/// check_box() does for the whole mesh.
Surface surface_of(const TriangleMesh& mesh);

/// Returns the surface of some triangles of a mesh, given the surface of them all. It holds the
/// vertices that other triangles have, too. Throws InvalidMesh as check_box() does.
Surface surface_of_selection(const Surface& whole, const TriangleMesh& mesh,
                             const Selection& selection);

/// Returns the surface of the selected triangles, except for those whose three vertices have
/// strength 0. It holds the vertices that other triangles have, too, those with strength 0, those
/// on the rim of the mesh unless it is Free, and the rest of slivers that have a held side. The
/// mesh and the inputs must have passed validate(). Throws InvalidMesh as check_box() does, for the
/// whole mesh and for the surface, and if all selected triangles have strength 0 or no area.
Surface surface_of(const TriangleMesh& mesh, const Inputs& inputs, BoundaryCondition boundary);

}  // namespace tracked_mcf
