// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The sides of all triangles that join two vertices, grouped by their smaller vertex.
struct Stars {
    RawVector<std::int64_t> begin;   ///< per vertex, its first side; at last the number of sides
    RawVector<std::uint64_t> sides;  ///< in a group sorted by the larger vertex, then by triangle
};

/// A side is one number: its larger vertex, then 3 * triangle + side in the lower bits.
constexpr unsigned kSideBits = 33;
std::uint64_t larger_vertex(std::uint64_t side) {
    return side >> kSideBits;
}
std::uint64_t place_of(std::uint64_t side) {
    return side & ((std::uint64_t{1} << kSideBits) - 1);
}

/// Calls visit(smaller vertex, larger vertex, triangle, side) for all sides that join two vertices.
template <class Visit>
void for_each_proper_side(const RawVector<Triangle>& triangles, const Visit& visit) {
    parallel_for_rows(static_cast<std::int64_t>(triangles.size()), [&](std::int32_t triangle) {
        const Triangle& t = triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
            if (a != b) visit(a, b, triangle, side);
        }
    });
}

/// A comparison sort of each small star is faster than a radix sort of all sides.
Stars stars_of(const RawVector<Triangle>& triangles, std::size_t vertex_count) {
    std::vector<std::atomic<std::int32_t>> counts(vertex_count);
    for_each_proper_side(triangles, [&](std::int32_t a, std::int32_t, std::int32_t, int) {
        counts[a].fetch_add(1, std::memory_order_relaxed);
    });
    const auto vertices = static_cast<std::int64_t>(vertex_count);
    Stars stars;
    parallel_prefix_sum(
        vertices, [&](std::int64_t vertex) { return counts[vertex].load(); }, stars.begin);
    stars.sides.resize(static_cast<std::size_t>(stars.begin.back()));
    for_each_proper_side(
        triangles, [&](std::int32_t a, std::int32_t b, std::int32_t triangle, int side) {
            // Threads place the sides of a star in any order; sorting makes it the same again.
            const std::int32_t left = counts[a].fetch_sub(1, std::memory_order_relaxed);
            stars.sides[stars.begin[a] + left - 1] =
                static_cast<std::uint64_t>(b) << kSideBits |
                static_cast<std::uint64_t>(3 * std::int64_t{triangle} + side);
        });
    parallel_for_rows(vertices, [&](std::int32_t vertex) {
        std::sort(stars.sides.begin() + stars.begin[vertex],
                  stars.sides.begin() + stars.begin[vertex + 1]);
    });
    return stars;
}

void number_edges(MeshTopology& topology) {
    const std::size_t vertex_count = topology.welded.size();
    const Stars stars = stars_of(topology.triangles, vertex_count);
    topology.edges.resize(topology.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(topology.edges.size()), [&](std::int32_t triangle) {
        topology.edges[triangle].fill(MeshTopology::kNoEdge);
    });
    const auto begins_edge = [&](std::int64_t vertex, std::int64_t i) {
        return i == stars.begin[vertex] ||
               larger_vertex(stars.sides[i]) != larger_vertex(stars.sides[i - 1]);
    };
    const auto count_edges = [&](std::int64_t vertex) {
        std::int64_t count = 0;
        for (std::int64_t i = stars.begin[vertex]; i < stars.begin[vertex + 1]; ++i) {
            count += begins_edge(vertex, i) ? 1 : 0;
        }
        return count;
    };
    const auto edge_count = parallel_scan<std::int64_t>(
        static_cast<std::int64_t>(vertex_count), count_edges,
        [&](std::int64_t begin, std::int64_t end, std::int64_t edges_before) {
            std::int64_t edge = edges_before - 1;
            for (std::int64_t vertex = begin; vertex < end; ++vertex) {
                for (std::int64_t i = stars.begin[vertex]; i < stars.begin[vertex + 1]; ++i) {
                    edge += begins_edge(vertex, i) ? 1 : 0;
                    const std::uint64_t place = place_of(stars.sides[i]);
                    topology.edges[place / 3][place % 3] = static_cast<std::int32_t>(edge);
                }
            }
        });
    if (edge_count > std::numeric_limits<std::int32_t>::max()) {
        throw InvalidMesh("The mesh has more than 2147483647 edges; simplify it first.");
    }
    topology.edge_count = static_cast<std::int32_t>(edge_count);
}

bool has_equal_vertices(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

MeshTopology topology_of(const TriangleMesh& mesh) {
    MeshTopology topology;
    topology.referenced = referenced_vertices(mesh);
    topology.welded = weld_coincident_vertices(mesh, topology.referenced);
    topology.triangles.resize(mesh.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(mesh.triangles.size()), [&](std::int32_t triangle) {
        for (int i = 0; i < 3; ++i) {
            topology.triangles[triangle][i] = topology.welded[mesh.triangles[triangle][i]];
        }
    });
    number_edges(topology);
    return topology;
}

std::int64_t count_vertices(const MeshTopology& topology) {
    const auto count = static_cast<std::int64_t>(topology.welded.size());
    Marks welded(count);
    parallel_for_rows(count, [&](std::int32_t vertex) {
        if (topology.referenced[vertex] != 0) welded.set(topology.welded[vertex]);
    });
    return welded.count();
}

std::vector<std::uint8_t> boundary_edges(const MeshTopology& topology) {
    const auto triangle_count = static_cast<std::int64_t>(topology.triangles.size());
    const auto for_each_side = [&](const auto& visit) {
        parallel_for_rows(triangle_count, [&](std::int32_t triangle) {
            const Triangle& t = topology.triangles[triangle];
            if (has_equal_vertices(t)) return;
            for (int side = 0; side < 3; ++side) {
                visit(triangle, side, topology.edges[triangle][side], t[(side + 2) % 3]);
            }
        });
    };
    // An edge is inside the surface if two of its triangles have different third vertices. Each
    // edge stores the third vertex of any of its triangles, and is compared with the others.
    std::vector<std::atomic<std::int32_t>> opposite(static_cast<std::size_t>(topology.edge_count));
    for_each_side([&](std::int32_t, int, std::int32_t edge, std::int32_t third) {
        opposite[edge].store(third, std::memory_order_relaxed);
    });
    Marks inside(topology.edge_count);
    for_each_side([&](std::int32_t, int, std::int32_t edge, std::int32_t third) {
        if (opposite[edge].load(std::memory_order_relaxed) != third) inside.set(edge);
    });
    std::vector<std::uint8_t> boundary(topology.triangles.size(), 0);
    for_each_side([&](std::int32_t triangle, int side, std::int32_t edge, std::int32_t) {
        if (!inside[edge]) boundary[triangle] |= static_cast<std::uint8_t>(1 << side);
    });
    return boundary;
}

namespace {

/// Returns whether the triangles of every edge pass along it at most `most` times more often in one
/// direction than in the other.
bool are_balanced(const MeshTopology& topology, int most) {
    std::vector<std::atomic<std::int32_t>> balance(static_cast<std::size_t>(topology.edge_count));
    for_each_edge(topology, [&](std::int32_t triangle, int side, std::int32_t edge) {
        const Triangle& t = topology.triangles[triangle];
        const int direction = t[side] < t[(side + 1) % 3] ? 1 : -1;
        balance[edge].fetch_add(direction, std::memory_order_relaxed);
    });
    return std::all_of(balance.begin(), balance.end(),
                       [&](const auto& sum) { return std::abs(sum.load()) <= most; });
}

}  // namespace

bool is_oriented_consistently(const MeshTopology& topology) {
    return are_balanced(topology, 1);
}

bool bounds_volume(const MeshTopology& topology) {
    return are_balanced(topology, 0);
}

}  // namespace tracked_mcf
