#include "tests/benchmark/vertex_order.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "filter_tracked_mcf/core/morton.h"

namespace tracked_mcf::benchmark {

namespace {

/// Of every vertex the vertices that share a triangle with it, most of them twice.
struct Neighbours {
    std::vector<std::int32_t> begin;  ///< of every vertex, and the end
    std::vector<std::int32_t> vertices;
};

Neighbours neighbours_of(const TriangleMesh& mesh) {
    Neighbours neighbours;
    neighbours.begin.assign(mesh.positions.size() + 1, 0);
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) neighbours.begin[vertex + 1] += 2;
    }
    std::partial_sum(neighbours.begin.begin(), neighbours.begin.end(), neighbours.begin.begin());
    neighbours.vertices.resize(neighbours.begin.back());
    std::vector<std::int32_t> next(neighbours.begin.begin(), neighbours.begin.end() - 1);
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            neighbours.vertices[next[t[i]]++] = t[(i + 1) % 3];
            neighbours.vertices[next[t[i]]++] = t[(i + 2) % 3];
        }
    }
    return neighbours;
}

/// Appends the vertices that are connected with `start` to `order`, breadth first.
void append_breadth_first(const Neighbours& neighbours, std::int32_t start,
                          std::vector<std::uint8_t>& visited, std::vector<std::int32_t>& order) {
    visited[start] = 1;
    std::size_t next = order.size();
    order.push_back(start);
    for (; next < order.size(); ++next) {
        const std::int32_t vertex = order[next];
        for (std::int32_t k = neighbours.begin[vertex]; k < neighbours.begin[vertex + 1]; ++k) {
            const std::int32_t neighbour = neighbours.vertices[k];
            if (std::exchange(visited[neighbour], std::uint8_t{1}) == 0) order.push_back(neighbour);
        }
    }
}

/// Every part is begun at the vertex that a first search from anywhere in it has reached last.
std::vector<std::int32_t> reverse_cuthill_mckee(const TriangleMesh& mesh) {
    const Neighbours neighbours = neighbours_of(mesh);
    const auto count = static_cast<std::int32_t>(mesh.positions.size());
    std::vector<std::uint8_t> found(count);
    std::vector<std::uint8_t> visited(count);
    std::vector<std::int32_t> order;
    std::vector<std::int32_t> part;
    order.reserve(count);
    for (std::int32_t vertex = 0; vertex < count; ++vertex) {
        if (visited[vertex] != 0) continue;
        part.clear();
        append_breadth_first(neighbours, vertex, found, part);
        append_breadth_first(neighbours, part.back(), visited, order);
    }
    std::reverse(order.begin(), order.end());
    return order;
}

std::vector<std::int32_t> morton_order(const TriangleMesh& mesh) {
    constexpr double cells_per_side = 1 << 20;
    Eigen::Vector3d low = mesh.positions.front();
    Eigen::Vector3d high = low;
    for (const Eigen::Vector3d& p : mesh.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double scale = cells_per_side / (1e-300 + 1.0001 * (high - low).maxCoeff());
    std::vector<std::pair<MortonCode, std::int32_t>> keys;
    keys.reserve(mesh.positions.size());
    for (const Eigen::Vector3d& p : mesh.positions) {
        const Eigen::Vector3i cell = (scale * (p - low)).cast<std::int32_t>();
        keys.emplace_back(morton_code({cell[0], cell[1], cell[2]}),
                          static_cast<std::int32_t>(keys.size()));
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::int32_t> order;
    order.reserve(keys.size());
    for (const auto& [key, vertex] : keys) order.push_back(vertex);
    return order;
}

}  // namespace

VertexOrder parse_vertex_order(const std::string& name) {
    if (name == "given") return VertexOrder::AsGiven;
    if (name == "rcm") return VertexOrder::ReverseCuthillMcKee;
    if (name == "morton") return VertexOrder::Morton;
    throw std::invalid_argument("there is no order '" + name + "' of vertices");
}

std::vector<std::int32_t> ordered_vertices(const TriangleMesh& mesh, VertexOrder order) {
    if (order == VertexOrder::ReverseCuthillMcKee) return reverse_cuthill_mckee(mesh);
    if (order == VertexOrder::Morton) return morton_order(mesh);
    std::vector<std::int32_t> vertices(mesh.positions.size());
    std::iota(vertices.begin(), vertices.end(), 0);
    return vertices;
}

}  // namespace tracked_mcf::benchmark
