#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

/// Between any vcglib mesh type, of floats or doubles, and the core's plain mesh. Nothing but the
/// members that all of vcglib's triangle meshes share is used, so that one bridge serves every
/// host.
namespace tracked_mcf {

namespace mesh_bridge_detail {

/// No vertex has this index: the core's validation turns it into a message for the user.
inline constexpr std::int32_t kNoVertex = -1;

template <class VcgMesh>
std::size_t number_of_vertices(const VcgMesh& mesh) {
    const auto exists = [](const auto& vertex) { return !vertex.IsD(); };
    return static_cast<std::size_t>(std::count_if(mesh.vert.begin(), mesh.vert.end(), exists));
}

/// For every vertex in memory, its index among those that are not deleted.
template <class VcgMesh>
std::vector<std::int32_t> indices_without_deleted(const VcgMesh& mesh) {
    std::vector<std::int32_t> indices;
    indices.reserve(mesh.vert.size());
    std::int32_t next = 0;
    for (const auto& vertex : mesh.vert) indices.push_back(vertex.IsD() ? kNoVertex : next++);
    return indices;
}

/// The new index of a face's vertex. A pointer that is null, or leads out of the mesh or to a
/// deleted vertex, is a damaged mesh that some filters and files leave behind: kNoVertex.
template <class VcgMesh>
std::int32_t index_of(const typename VcgMesh::VertexType* vertex, const VcgMesh& mesh,
                      const std::vector<std::int32_t>& indices) {
    const auto* const first = mesh.vert.data();
    const auto* const last = first + mesh.vert.size();
    const std::less<> before;  // a total order even over pointers into other arrays
    if (vertex == nullptr || before(vertex, first) || !before(vertex, last)) return kNoVertex;
    return indices[static_cast<std::size_t>(vertex - first)];
}

}  // namespace mesh_bridge_detail

/// The vertices and faces of `mesh` that are not deleted, in their order.
template <class VcgMesh>
TriangleMesh to_triangle_mesh(const VcgMesh& mesh) {
    using namespace mesh_bridge_detail;
    TriangleMesh result;
    result.positions.reserve(mesh.vert.size());
    for (const auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        const auto& p = vertex.cP();
        result.positions.emplace_back(p[0], p[1], p[2]);
    }
    const std::vector<std::int32_t> indices = indices_without_deleted(mesh);
    result.triangles.reserve(mesh.face.size());
    for (const auto& face : mesh.face) {
        if (face.IsD()) continue;
        result.triangles.push_back({index_of(face.cV(0), mesh, indices),
                                    index_of(face.cV(1), mesh, indices),
                                    index_of(face.cV(2), mesh, indices)});
    }
    return result;
}

/// Of each of those faces, whether it is selected. The flags are looked at themselves, since
/// counters of selected faces are often out of date.
template <class VcgMesh>
Selection selected_faces(const VcgMesh& mesh) {
    Selection result;
    result.reserve(mesh.face.size());
    for (const auto& face : mesh.face) {
        if (!face.IsD()) result.push_back(face.IsS() ? 1 : 0);
    }
    return result;
}

/// Whether any face is selected.
template <class VcgMesh>
bool has_selected_faces(const VcgMesh& mesh) {
    return std::any_of(mesh.face.begin(), mesh.face.end(),
                       [](const auto& face) { return !face.IsD() && face.IsS(); });
}

/// Gives the vertices of `mesh` the positions of `moved`, which to_triangle_mesh made of it;
/// deleted vertices stay as they are. A vertex that has not moved keeps its bits. Normals and
/// bounding box are the caller's to update.
template <class VcgMesh>
void write_positions(const TriangleMesh& moved, VcgMesh& mesh) {
    using Scalar = typename VcgMesh::ScalarType;
    // Hosts process events while a filter runs, so another may have run on the same mesh meanwhile.
    if (moved.positions.size() != mesh_bridge_detail::number_of_vertices(mesh)) {
        throw InvalidMesh("The mesh was changed while the filter ran; it has been left like that.");
    }
    auto position = moved.positions.begin();
    for (auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        const Eigen::Vector3d& p = *position++;
        // Float to double and back is exact but for a NaN's payload; a position with a NaN is that
        // of an unused vertex, which does not move.
        if (p.hasNaN()) continue;
        vertex.P() = {static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]),
                      static_cast<Scalar>(p[2])};
    }
}

}  // namespace tracked_mcf
