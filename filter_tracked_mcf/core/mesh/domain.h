// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The part of a mesh that flows, and which of its edges and vertices are constrained.
///
/// The selected triangles flow as a surface of their own, but for those whose three vertices have
/// strength 0: these count as unselected. The seam is the set of edges that the surface shares with
/// unselected triangles. Unselected triangles act on the surface only by constraining
/// the seam and the vertices they share with it.
class Domain {
public:
    /// Constrains the seam, and the boundary of the mesh unless it is Free. The mesh and the inputs
    /// must have passed validate(); the mesh must outlive the domain. Throws InvalidMesh if all
    /// selected triangles have strength 0.
    Domain(const TriangleMesh& mesh, const Inputs& inputs, BoundaryCondition boundary);
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

    /// Returns which triangles of the mesh are the surface.
    const Selection& selection() const { return selection_; }
    /// Returns the number of selected triangles that do not flow because of their strength.
    std::int64_t zero_strength_count() const { return zero_strength_count_; }
    bool has_strengths() const { return !strength_.empty(); }
    /// Returns the strength of a vertex, see Inputs::strength.
    double strength(std::int32_t vertex) const {
        return has_strengths() ? strength_[topology_.welded[vertex]] : 1;
    }

    /// Returns the number of sides of the surface's triangles on the boundary of the mesh.
    std::int64_t boundary_edge_count() const { return boundary_edge_count_; }
    bool has_constraints() const;
    /// Returns how many vertices the surface has, and how many of these are constrained. Coincident
    /// ones count once.
    std::pair<std::int64_t, std::int64_t> vertex_counts() const;
    /// Returns whether all of the mesh flows, and is closed, with a well-defined volume inside.
    bool encloses_volume() const {
        return selection_.empty() && boundary_edge_count_ == 0 && topology_.bounds_volume();
    }

private:
    // Steps of the constructor, in order.
    void leave_zero_strength_out();
    void restrict_to_selection();
    void constrain_across_slivers(const std::vector<std::uint8_t>& slivers);
    void constrain_vertices();
    void leave_slivers_out(const std::vector<std::uint8_t>& slivers);

    template <class IsConstrained>
    void constrain_edges(const IsConstrained& is_constrained);

    const TriangleMesh& mesh_;
    std::vector<double> strength_;
    Selection selection_;
    std::int64_t zero_strength_count_ = 0;
    std::unique_ptr<std::vector<Triangle>> selected_triangles_;  ///< views outlive a move
    MeshTopology topology_;
    std::vector<std::uint8_t> constrained_edges_;
    std::vector<std::uint8_t> constrained_vertices_;
    std::int64_t boundary_edge_count_ = 0;
};

}  // namespace tracked_mcf
