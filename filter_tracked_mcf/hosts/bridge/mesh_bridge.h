// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

/// Converts between any vcglib mesh type, of floats or doubles, and the core's plain mesh. It uses
/// only members that all vcglib triangle meshes have, so one bridge serves every host.
namespace tracked_mcf {

namespace mesh_bridge_detail {

/// No vertex has this index. The core's validation turns it into a message for the user.
inline constexpr std::int32_t kNoVertex = -1;

/// Returns the new index of a face's vertex from those of all vertices in memory, or kNoVertex if
/// the pointer is null, leads out of the mesh, or leads to a deleted vertex. Some filters and files
/// leave such faces behind.
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

/// Returns the vertices and faces of `mesh` that are not deleted, in their order.
template <class VcgMesh>
TriangleMesh to_triangle_mesh(const VcgMesh& mesh) {
    using namespace mesh_bridge_detail;
    TriangleMesh result;
    result.single_precision = sizeof(typename VcgMesh::ScalarType) == sizeof(float);
    result.positions.reserve(mesh.vert.size());
    std::vector<std::int32_t> indices(mesh.vert.size(), kNoVertex);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (mesh.vert[i].IsD()) continue;
        indices[i] = static_cast<std::int32_t>(result.positions.size());
        const auto& p = mesh.vert[i].cP();
        result.positions.emplace_back(p[0], p[1], p[2]);
    }
    result.triangles.reserve(mesh.face.size());
    for (const auto& face : mesh.face) {
        if (face.IsD()) continue;
        result.triangles.push_back({index_of(face.cV(0), mesh, indices),
                                    index_of(face.cV(1), mesh, indices),
                                    index_of(face.cV(2), mesh, indices)});
    }
    return result;
}

/// Returns whether each face that is not deleted is selected. It reads the flags, because the
/// mesh's counter of selected faces is often out of date.
template <class VcgMesh>
Selection selected_faces(const VcgMesh& mesh) {
    Selection result;
    result.reserve(mesh.face.size());
    for (const auto& face : mesh.face) {
        if (!face.IsD()) result.push_back(face.IsS() ? 1 : 0);
    }
    return result;
}

/// Returns whether any face is selected.
template <class VcgMesh>
bool has_selected_faces(const VcgMesh& mesh) {
    return std::any_of(mesh.face.begin(), mesh.face.end(),
                       [](const auto& face) { return !face.IsD() && face.IsS(); });
}

/// Returns the quality of each vertex that is not deleted.
template <class VcgMesh>
std::vector<double> vertex_quality(const VcgMesh& mesh) {
    std::vector<double> result;
    result.reserve(mesh.vert.size());
    for (const auto& vertex : mesh.vert) {
        if (!vertex.IsD()) result.push_back(static_cast<double>(vertex.cQ()));
    }
    return result;
}

/// Gives the vertices of `mesh` the positions of `moved`, which to_triangle_mesh made from it.
/// Deleted vertices keep their positions; a vertex that has not moved keeps its bits. The caller
/// updates normals and bounding box. Throws InvalidMesh if the number of vertices has changed.
template <class VcgMesh>
void write_positions(const TriangleMesh& moved, VcgMesh& mesh) {
    using Scalar = typename VcgMesh::ScalarType;
    const auto count = std::count_if(mesh.vert.begin(), mesh.vert.end(),
                                     [](const auto& vertex) { return !vertex.IsD(); });
    // Hosts process events while a filter runs, so another filter may have changed the mesh.
    if (moved.positions.size() != static_cast<std::size_t>(count)) {
        throw InvalidMesh("The mesh changed while the filter ran. Its positions were not written.");
    }
    auto position = moved.positions.begin();
    for (auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        const Eigen::Vector3d& p = *position++;
        // Float to double and back is exact except for a NaN's payload. Only unused vertices have
        // NaNs, and they do not move.
        if (p.hasNaN()) continue;
        vertex.P() = {static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]),
                      static_cast<Scalar>(p[2])};
    }
}

/// Gives the vertices of `mesh` that are not deleted these numbers as their quality, after
/// write_positions() has found that they are as many.
template <class VcgMesh>
void write_quality(const std::vector<double>& quality, VcgMesh& mesh) {
    auto number = quality.begin();
    for (auto& vertex : mesh.vert) {
        if (vertex.IsD()) continue;
        vertex.Q() = static_cast<std::decay_t<decltype(vertex.Q())>>(*number++);
    }
}

}  // namespace tracked_mcf
