// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/vertex_order.h"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "filter_tracked_mcf/core/flow/cells/grid.h"

namespace tracked_mcf::benchmark {

namespace {

/// Returns both directions of each triangle's edges. An edge of two triangles occurs twice.
std::vector<std::pair<std::int32_t, std::int32_t>> directed_edges(const TriangleMesh& mesh) {
    std::vector<std::pair<std::int32_t, std::int32_t>> edges;
    edges.reserve(6 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            edges.emplace_back(t[i], t[(i + 1) % 3]);
            edges.emplace_back(t[(i + 1) % 3], t[i]);
        }
    }
    return edges;
}

std::vector<std::int32_t> reverse_cuthill_mckee(const TriangleMesh& mesh) {
    const auto edges = directed_edges(mesh);
    const boost::compressed_sparse_row_graph<boost::directedS> graph(
        boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), mesh.positions.size());
    std::vector<boost::default_color_type> colors(mesh.positions.size());
    std::vector<std::int32_t> order(mesh.positions.size());
    boost::cuthill_mckee_ordering(
        graph, order.rbegin(),
        boost::make_iterator_property_map(colors.begin(), get(boost::vertex_index, graph)),
        boost::make_out_degree_map(graph));
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
