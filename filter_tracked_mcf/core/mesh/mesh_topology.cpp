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
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// Returns the sides of all triangles that are edges, sorted by edge. A side's key holds its
/// smaller vertex in the upper bits and its larger vertex in the lower ones; its value is 3 *
/// triangle + side.
RawVector<KeyValue> sorted_sides(const RawVector<Triangle>& triangles, std::size_t vertex_count) {
    unsigned vertex_bits = 0;
    while ((vertex_count >> vertex_bits) != 0) ++vertex_bits;
    // Sides that join a vertex to itself are no edges. They get this key, so they come last.
    const std::uint64_t no_edge = std::uint64_t{vertex_count} << vertex_bits;
    RawVector<KeyValue> sides(3 * triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(triangles.size()), [&](std::int32_t triangle) {
        const Triangle& t = triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
            const std::uint64_t key =
                static_cast<std::uint64_t>(a) << vertex_bits | static_cast<std::uint64_t>(b);
            const auto value = static_cast<std::uint64_t>(3 * std::int64_t{triangle} + side);
            sides[value] = {a == b ? no_edge : key, value};
        }
    });
    sort_by_key(sides);
    while (!sides.empty() && sides.back().key == no_edge) sides.pop_back();
    return sides;
}

void number_edges(MeshTopology& topology) {
    const RawVector<KeyValue> sides = sorted_sides(topology.triangles, topology.welded.size());
    topology.edges.resize(topology.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(topology.edges.size()), [&](std::int32_t triangle) {
        topology.edges[triangle].fill(MeshTopology::kNoEdge);
    });
    const auto begins_edge = runs_by(sides, [](const KeyValue& side) { return side.key; });
    const std::int64_t edge_count = parallel_scan<std::int64_t>(
        static_cast<std::int64_t>(sides.size()), begins_edge,
        [&](std::int64_t begin, std::int64_t end, std::int64_t edges_before) {
            std::int64_t edge = edges_before - 1;
            for (std::int64_t i = begin; i < end; ++i) {
                edge += begins_edge(i) ? 1 : 0;
                topology.edges[sides[i].value / 3][sides[i].value % 3] =
                    static_cast<std::int32_t>(edge);
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
    topology.welded = weld_coincident_vertices(mesh);
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
    return vertices_of(topology.triangles, topology.welded.size()).count();
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
    parallel_for_rows(static_cast<std::int64_t>(topology.triangles.size()),
                      [&](std::int32_t triangle) {
                          const Triangle& t = topology.triangles[triangle];
                          for (int side = 0; side < 3; ++side) {
                              const std::int32_t edge = topology.edges[triangle][side];
                              if (edge == MeshTopology::kNoEdge) continue;
                              const int direction = t[side] < t[(side + 1) % 3] ? 1 : -1;
                              balance[edge].fetch_add(direction, std::memory_order_relaxed);
                          }
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
