// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Throws InvalidParameter unless `selection` is empty or has a flag for every triangle,
/// InvalidMesh if it selects no triangle.
void check_selection(const TriangleMesh& mesh, const Selection& selection);

/// Returns the selection without the triangles whose three vertices have strength 0. The mesh is
/// valid, and so is the selection. Throws InvalidMesh if no triangle is left.
Selection without_zero_strength(const TriangleMesh& mesh, const Selection& selection);

/// The part of a mesh that flows, and which of its edges and vertices are constrained.
///
/// The selected triangles flow as a surface of their own. The seam is the set of edges that they
/// share with unselected triangles. Unselected triangles act on the surface only by constraining
/// the seam and the vertices they share with it.
class Domain {
public:
    /// Constrains the seam, and the boundary of the mesh unless it is Free. `mesh` must outlive the
    /// domain. Throws as check_selection() does.
    Domain(const TriangleMesh& mesh, const Selection& selection, BoundaryCondition boundary);
    /// All of a mesh flows.
    Domain(const TriangleMesh& mesh, BoundaryCondition boundary) : Domain(mesh, {}, boundary) {}

    /// Returns the whole mesh.
    const TriangleMesh& mesh() const { return mesh_; }
    /// Returns all vertices of the mesh with the triangles that flow.
    SurfaceView surface() const {
        return {mesh_.positions, selected_triangles_ ? *selected_triangles_ : mesh_.triangles};
    }
    /// Returns the connectivity of the surface by itself, so the seam is part of its boundary.
    /// Vertices have the numbers of the whole mesh.
    const MeshTopology& topology() const { return topology_; }

    /// Returns flags, per triangle of the surface, of its constrained sides. Slivers (triangles
    /// without a reliable normal) pass their constraints on to their neighbours with area.
    const std::vector<std::uint8_t>& constrained_edges() const { return constrained_edges_; }
    /// Returns, per vertex of the mesh, whether it keeps its bits: vertices of constrained edges,
    /// of unselected triangles and with strength 0 do. A constrained vertex on no constrained edge
    /// may separate from the surface.
    const std::vector<std::uint8_t>& constrained_vertices() const { return constrained_vertices_; }

    /// Returns the strength of a vertex, see TriangleMesh::strength.
    double strength(std::int32_t vertex) const {
        return mesh_.strength.empty() ? 1 : mesh_.strength[topology_.welded[vertex]];
    }

    /// Returns the number of sides of the surface's triangles on the boundary of the mesh.
    std::int64_t boundary_edge_count() const { return boundary_edge_count_; }
    bool has_constraints() const;
    /// Returns whether all vertices of the surface are constrained.
    bool constrains_all_vertices() const;

private:
    // Steps of the constructor, in order.
    void restrict_to(const Selection& selection);
    void constrain_across_slivers(const std::vector<std::uint8_t>& slivers);
    void constrain_vertices(const Selection& selection);
    void leave_slivers_out(const std::vector<std::uint8_t>& slivers);

    template <class IsConstrained>
    void constrain_edges(const IsConstrained& is_constrained);

    const TriangleMesh& mesh_;
    std::optional<std::vector<Triangle>> selected_triangles_;
    MeshTopology topology_;
    std::vector<std::uint8_t> constrained_edges_;
    std::vector<std::uint8_t> constrained_vertices_;
    std::int64_t boundary_edge_count_ = 0;
};

}  // namespace tracked_mcf
