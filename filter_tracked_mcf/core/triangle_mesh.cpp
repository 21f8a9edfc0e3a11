#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

bool index_in_range(std::int32_t index, const TriangleMesh& mesh) {
    return index >= 0 && static_cast<std::size_t>(index) < mesh.positions.size();
}

void check_triangle(const TriangleMesh& mesh, const Triangle& triangle) {
    for (const std::int32_t vertex : triangle) {
        if (!index_in_range(vertex, mesh)) {
            throw InvalidMesh("A triangle refers to vertex " + std::to_string(vertex) +
                              ", which does not exist: the mesh file is damaged.");
        }
        if (!mesh.positions[vertex].allFinite()) {
            throw InvalidMesh("Vertex " + std::to_string(vertex) +
                              " has a coordinate that is not a finite number; remove or repair it "
                              "first.");
        }
    }
}

/// Lexicographic order of positions; -0 and 0 are equal.
bool position_less(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

void validate(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) throw InvalidMesh("The mesh is empty: it has no vertices.");
    if (mesh.triangles.empty()) {
        throw InvalidMesh(
            "The mesh has no faces; mean-curvature flow needs a surface, not a point cloud.");
    }
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (mesh.positions.size() > most || mesh.triangles.size() > most) {
        throw InvalidMesh(
            "The mesh has more than 2147483647 vertices or faces; simplify it first.");
    }
    for (const Triangle& triangle : mesh.triangles) check_triangle(mesh, triangle);
}

std::vector<bool> referenced_vertices(const TriangleMesh& mesh) {
    std::vector<bool> referenced(mesh.positions.size(), false);
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::int32_t vertex : triangle) referenced[vertex] = true;
    }
    return referenced;
}

std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh) {
    std::vector<std::int32_t> welded(mesh.positions.size());
    std::iota(welded.begin(), welded.end(), 0);

    const std::vector<bool> referenced = referenced_vertices(mesh);
    std::vector<std::int32_t> order;
    for (const std::int32_t vertex : welded) {
        if (referenced[vertex]) order.push_back(vertex);
    }
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        if (position_less(mesh.positions[a], mesh.positions[b])) return true;
        if (position_less(mesh.positions[b], mesh.positions[a])) return false;
        return a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (mesh.positions[order[i]] == mesh.positions[order[i - 1]]) {
            welded[order[i]] = welded[order[i - 1]];
        }
    }
    return welded;
}

Eigen::Vector3d twice_vector_area(const TriangleMesh& mesh, const Triangle& triangle) {
    const Eigen::Vector3d& origin = mesh.positions[triangle[0]];
    return (mesh.positions[triangle[1]] - origin).cross(mesh.positions[triangle[2]] - origin);
}

double surface_area(const TriangleMesh& mesh) {
    double twice = 0;
    for (const Triangle& triangle : mesh.triangles)
        twice += twice_vector_area(mesh, triangle).norm();
    return 0.5 * twice;
}

// Both sum relative to a vertex, so that far from the origin no digits are lost.

Eigen::Vector3d surface_centroid(const TriangleMesh& mesh) {
    const Eigen::Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double weight = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const double area = twice_vector_area(mesh, triangle).norm();
        for (const std::int32_t vertex : triangle) moment += area * (mesh.positions[vertex] - near);
        weight += 3 * area;
    }
    return near + moment / weight;
}

double enclosed_volume(const TriangleMesh& mesh) {
    const Eigen::Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    double six_times = 0;
    for (const Triangle& triangle : mesh.triangles) {
        six_times += (mesh.positions[triangle[0]] - near).dot(twice_vector_area(mesh, triangle));
    }
    return six_times / 6;
}

}  // namespace tracked_mcf
