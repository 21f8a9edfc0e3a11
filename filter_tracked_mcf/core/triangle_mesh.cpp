#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/marks.h"
#include "filter_tracked_mcf/core/parallel.h"
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

/// The same for equal positions, 0 and -0 being equal, and hardly ever for others.
std::uint64_t hash_of(const Eigen::Vector3d& position) {
    std::uint64_t hash = 0;
    for (const double coordinate : position) {
        const double unsigned_zero = coordinate + 0.0;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &unsigned_zero, sizeof(bits));
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
        hash ^= hash >> 32U;
    }
    return hash;
}

/// A vertex and some bits of its position's hash.
struct HashedVertex {
    std::uint32_t hash;
    std::int32_t vertex;
};

/// The referenced vertices by hash, those of the same one by index. The hash has few bits, to be
/// soon sorted by, but enough that few positions share one.
RawVector<HashedVertex> vertices_by_hash(const TriangleMesh& mesh) {
    const std::vector<std::uint8_t> referenced = referenced_vertices(mesh);
    unsigned bits = 8;
    while (bits < 30 && (std::size_t{1} << (bits - 2)) < mesh.positions.size()) ++bits;
    auto vertices = parallel_collect<HashedVertex, RawVector<HashedVertex>>(
        static_cast<std::int64_t>(mesh.positions.size()),
        [&](std::int64_t begin, std::int64_t end, std::vector<HashedVertex>& out) {
            for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                if (referenced[vertex] == 0) continue;
                const std::uint64_t hash = hash_of(mesh.positions[vertex]) >> (64 - bits);
                out.push_back({static_cast<std::uint32_t>(hash), vertex});
            }
        });
    sort_by(vertices, [](const HashedVertex& entry) { return std::uint64_t{entry.hash}; });
    return vertices;
}

/// Welds the vertices from first to last, which are all that have the same hash, by index.
void weld(const TriangleMesh& mesh, const HashedVertex* first, const HashedVertex* last,
          std::vector<std::int32_t>& different, std::vector<std::int32_t>& welded) {
    different.clear();
    for (; first != last; ++first) {
        const std::int32_t vertex = first->vertex;
        const auto same = std::find_if(different.begin(), different.end(), [&](std::int32_t other) {
            return mesh.positions[other] == mesh.positions[vertex];
        });
        if (same == different.end()) {
            different.push_back(vertex);
        } else {
            welded[vertex] = *same;
        }
    }
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

std::vector<std::uint8_t> referenced_vertices(const TriangleMesh& mesh) {
    Marks referenced(static_cast<std::int64_t>(mesh.positions.size()));
    parallel_for_rows(static_cast<std::int64_t>(mesh.triangles.size()), [&](std::int32_t triangle) {
        for (const std::int32_t vertex : mesh.triangles[triangle]) referenced.set(vertex);
    });
    return referenced.flags();
}

std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh) {
    std::vector<std::int32_t> welded(mesh.positions.size());
    parallel_for_rows(static_cast<std::int64_t>(welded.size()),
                      [&](std::int32_t vertex) { welded[vertex] = vertex; });
    const RawVector<HashedVertex> vertices = vertices_by_hash(mesh);
    const auto differs = [&](std::int64_t i) {
        return i == 0 || vertices[i].hash != vertices[i - 1].hash;
    };
    parallel_for_runs(
        static_cast<std::int64_t>(vertices.size()), differs,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<std::int32_t> different;
            for_each_run(begin, end, differs, [&](std::int64_t first, std::int64_t last) {
                weld(mesh, vertices.data() + first, vertices.data() + last, different, welded);
            });
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
