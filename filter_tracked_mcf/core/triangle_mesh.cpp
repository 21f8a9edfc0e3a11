#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/sorting.h"

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

/// The same for equal positions, 0 and -0 being equal, and hardly ever for others. Of no more bits
/// than are soon sorted by.
std::uint64_t hash_of(const Eigen::Vector3d& position) {
    constexpr unsigned used_bits = 44;
    std::uint64_t hash = 0;
    for (const double coordinate : position) {
        const double unsigned_zero = coordinate + 0.0;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &unsigned_zero, sizeof(bits));
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
        hash ^= hash >> 32U;
    }
    return hash >> (64U - used_bits);
}

/// The referenced vertices by the hash of their positions, those of the same one by index.
std::vector<KeyValue> vertices_by_hash(const TriangleMesh& mesh) {
    const std::vector<bool> referenced = referenced_vertices(mesh);
    std::vector<KeyValue> vertices;
    vertices.reserve(mesh.positions.size());
    serial_for(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int64_t vertex) {
        if (!referenced[vertex]) return;
        vertices.push_back({hash_of(mesh.positions[vertex]), static_cast<std::uint64_t>(vertex)});
    });
    sort_by_key(vertices);
    return vertices;
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
    for_each_item(mesh.triangles,
                  [&](const Triangle& triangle) { check_triangle(mesh, triangle); });
}

std::vector<bool> referenced_vertices(const TriangleMesh& mesh) {
    std::vector<bool> referenced(mesh.positions.size(), false);
    for_each_item(mesh.triangles, [&](const Triangle& triangle) {
        for (const std::int32_t vertex : triangle) referenced[vertex] = true;
    });
    return referenced;
}

std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh) {
    std::vector<std::int32_t> welded(mesh.positions.size());
    std::iota(welded.begin(), welded.end(), 0);

    std::uint64_t hash = 0;
    std::vector<std::int32_t> firsts;  // of that hash, at different positions
    for_each_item(vertices_by_hash(mesh), [&](const KeyValue& entry) {
        if (entry.key != hash) firsts.clear();
        hash = entry.key;
        const auto vertex = static_cast<std::int32_t>(entry.value);
        const auto first = std::find_if(firsts.begin(), firsts.end(), [&](std::int32_t other) {
            return mesh.positions[other] == mesh.positions[vertex];
        });
        if (first == firsts.end()) {
            firsts.push_back(vertex);
        } else {
            welded[vertex] = *first;
        }
    });
    return welded;
}

Eigen::Vector3d twice_vector_area(const TriangleMesh& mesh, const Triangle& triangle) {
    const Eigen::Vector3d& origin = mesh.positions[triangle[0]];
    return (mesh.positions[triangle[1]] - origin).cross(mesh.positions[triangle[2]] - origin);
}

double surface_area(const TriangleMesh& mesh) {
    double twice = 0;
    for_each_item(mesh.triangles, [&](const Triangle& triangle) {
        twice += twice_vector_area(mesh, triangle).norm();
    });
    return 0.5 * twice;
}

// Both sum relative to a vertex, so that far from the origin no digits are lost.

Eigen::Vector3d surface_centroid(const TriangleMesh& mesh) {
    const Eigen::Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double weight = 0;
    for_each_item(mesh.triangles, [&](const Triangle& triangle) {
        const double area = twice_vector_area(mesh, triangle).norm();
        for (const std::int32_t vertex : triangle) moment += area * (mesh.positions[vertex] - near);
        weight += 3 * area;
    });
    return near + moment / weight;
}

double enclosed_volume(const TriangleMesh& mesh) {
    const Eigen::Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    double six_times = 0;
    for_each_item(mesh.triangles, [&](const Triangle& triangle) {
        six_times += (mesh.positions[triangle[0]] - near).dot(twice_vector_area(mesh, triangle));
    });
    return six_times / 6;
}

}  // namespace tracked_mcf
