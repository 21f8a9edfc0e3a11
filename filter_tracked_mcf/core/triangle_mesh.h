#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// Vertex indices of a triangle.
using Triangle = std::array<std::int32_t, 3>;

/// A plain triangle mesh, in the user's units. Anything is allowed that has a surface: several
/// components, non-manifold edges, inconsistent orientation, soups of unconnected triangles,
/// unreferenced vertices, and some degenerate triangles.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> positions;  ///< one per vertex
    std::vector<Triangle> triangles;         ///< indices into positions
};

/// Throws InvalidMesh unless the mesh has vertices and triangles, every index is in range, every
/// vertex that a triangle uses is finite. Unreferenced vertices are ignored, whatever they hold.
void validate(const TriangleMesh& mesh);

/// For every vertex: 1 if some triangle uses it, else 0.
std::vector<std::uint8_t> referenced_vertices(const TriangleMesh& mesh);

/// For every vertex: the smallest index of a referenced vertex at exactly the same position; an
/// unreferenced vertex is its own. A triangle soup welded this way is the mesh it came from.
std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh);

/// A triangle's normal, twice as long as its area in squared units of the mesh.
Eigen::Vector3d twice_vector_area(const TriangleMesh& mesh, const Triangle& triangle);

/// Surface area, in squared units of the mesh.
double surface_area(const TriangleMesh& mesh);

/// Centre of mass of the surface, which must have an area.
Eigen::Vector3d surface_centroid(const TriangleMesh& mesh);

/// The volume inside a closed mesh whose triangles are oriented consistently, in cubed units of the
/// mesh: negative if they are seen from outside in clockwise order.
double enclosed_volume(const TriangleMesh& mesh);

}  // namespace tracked_mcf
