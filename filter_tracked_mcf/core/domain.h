#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Of every triangle of a mesh, whether it flows (not 0) or stays. Empty: all flow.
using Selection = std::vector<std::uint8_t>;

/// Area of the selected triangles, in squared units of the mesh.
double surface_area(const TriangleMesh& mesh, const Selection& selection);

/// What flows of a mesh, and what of that is held.
///
/// Selected triangles flow as a surface of their own, on which the others act only by holding the
/// edges and vertices they share with it.
class Domain {
public:
    /// `mesh` must outlive this. The mesh's boundary is held unless it is Free; the seam to
    /// unselected triangles always is. Throws InvalidParameter unless `selection` is empty or says
    /// something of every triangle, InvalidMesh if it selects none.
    Domain(const TriangleMesh& mesh, const Selection& selection, BoundaryCondition boundary);
    /// All of a mesh.
    Domain(const TriangleMesh& mesh, BoundaryCondition boundary) : Domain(mesh, {}, boundary) {}

    /// All vertices of the mesh, and the triangles that flow.
    const TriangleMesh& surface() const { return part_ ? *part_ : mesh_; }
    /// Whether there are triangles that do not flow.
    bool is_part() const { return part_.has_value(); }
    /// The mesh's, for those triangles.
    const MeshTopology& topology() const { return topology_; }

    /// Of every triangle of the surface, bit i: its edge from corner i to (i + 1) % 3 is held.
    /// Where that is an edge of a triangle without area, its neighbours' are held in its stead:
    /// there the surface begins.
    const std::vector<std::uint8_t>& held_edges() const { return held_edges_; }
    /// Of every vertex of the mesh: it keeps its bits. Those of held edges, and those that stay
    /// because an unselected triangle has them; where such a vertex is on no held edge, as where
    /// two parts meet in a point, the surface leaves it behind.
    const std::vector<std::uint8_t>& held_vertices() const { return held_vertices_; }

    /// Sides of the surface's triangles that are on the boundary of the mesh.
    std::int64_t boundary_edge_count() const { return boundary_edge_count_; }
    bool holds_anything() const;

private:
    template <class Visit>
    void for_each_side(const Visit& visit) const;
    void take(const MeshTopology& whole, const Selection& selection);
    void hold_seam(const MeshTopology& whole, const Selection& selection);
    void hold_across_slivers();
    void leave_slivers_out();
    void hold_vertices(const MeshTopology& whole, const Selection& selection);

    const TriangleMesh& mesh_;
    std::optional<TriangleMesh> part_;
    MeshTopology topology_;
    std::vector<std::uint8_t> slivers_;  ///< of every triangle of the surface
    std::vector<std::uint8_t> held_edges_;
    std::vector<std::uint8_t> held_vertices_;
    std::int64_t boundary_edge_count_ = 0;
};

}  // namespace tracked_mcf
