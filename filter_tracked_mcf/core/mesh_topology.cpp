#include "filter_tracked_mcf/core/mesh_topology.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/marks.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// A side of a triangle that joins two different vertices.
struct Side {
    std::int32_t smaller, larger;  ///< vertex
    std::int32_t triangle;
    std::int32_t number;  ///< which of the triangle's sides
};

bool same_edge(const Side& a, const Side& b) {
    return a.smaller == b.smaller && a.larger == b.larger;
}

/// Sorts the sides that have the same smaller vertex, a few, by the larger one.
void sort_by_larger_vertex(RawVector<Side>& sides) {
    const auto differs = [&](std::int64_t i) {
        return i == 0 || sides[i].smaller != sides[i - 1].smaller;
    };
    parallel_for_runs(static_cast<std::int64_t>(sides.size()), differs,
                      [&](std::int64_t begin, std::int64_t end) {
                          for_each_run(begin, end, differs, [&](auto first, auto last) {
                              std::sort(
                                  sides.begin() + first, sides.begin() + last,
                                  [](const Side& a, const Side& b) { return a.larger < b.larger; });
                          });
                      });
}

/// All sides, those of an edge behind each other, in the order of their vertices.
RawVector<Side> sorted_sides(const RawVector<Triangle>& triangles) {
    // Sides that join a vertex to itself are no edges: they come last.
    constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
    RawVector<Side> sides(3 * triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(triangles.size()), [&](std::int32_t triangle) {
        const Triangle& t = triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
            sides[3 * std::int64_t{triangle} + side] = {a == b ? none : a, b, triangle, side};
        }
    });
    sort_by(sides, [](const Side& side) { return static_cast<std::uint64_t>(side.smaller); });
    while (!sides.empty() && sides.back().smaller == none) sides.pop_back();
    sort_by_larger_vertex(sides);
    return sides;
}

void number_edges(MeshTopology& topology) {
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    const RawVector<Side> sides = sorted_sides(topology.triangles);
    resize(topology.edges, static_cast<std::int64_t>(topology.triangles.size()));
    parallel_for_rows(static_cast<std::int64_t>(topology.edges.size()), [&](std::int32_t triangle) {
        topology.edges[triangle].fill(MeshTopology::kNoEdge);
    });
    const auto count = static_cast<std::int64_t>(sides.size());
    const auto begins_edge = [&](std::int64_t i) {
        return i == 0 || !same_edge(sides[i], sides[i - 1]);
    };
    const std::int64_t edge_count = number_blocks(
        count, begins_edge, [&](std::int64_t begin, std::int64_t end, std::int64_t edges_before) {
            std::int64_t edge = edges_before - 1;
            for (std::int64_t i = begin; i < end; ++i) {
                edge += begins_edge(i) ? 1 : 0;
                topology.edges[sides[i].triangle][sides[i].number] =
                    static_cast<std::int32_t>(edge);
            }
        });
    if (edge_count > most) {
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
    const auto count = static_cast<std::int64_t>(mesh.triangles.size());
    resize(topology.triangles, count);
    parallel_for_rows(count, [&](std::int32_t triangle) {
        for (int i = 0; i < 3; ++i) {
            topology.triangles[triangle][i] = topology.welded[mesh.triangles[triangle][i]];
        }
    });
    number_edges(topology);
    return topology;
}

std::int64_t count_vertices(const MeshTopology& topology) {
    Marks used(static_cast<std::int64_t>(topology.welded.size()));
    parallel_for_rows(static_cast<std::int64_t>(topology.triangles.size()),
                      [&](std::int32_t triangle) {
                          for (const std::int32_t vertex : topology.triangles[triangle])
                              used.set(vertex);
                      });
    return used.count();
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
    // Of every edge the third vertex of one of its triangles, whichever; then, whether others have
    // another.
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

bool is_oriented_consistently(const MeshTopology& topology) {
    std::vector<std::int32_t> balance(static_cast<std::size_t>(topology.edge_count), 0);
    serial_for(static_cast<std::int64_t>(topology.triangles.size()), [&](std::int64_t triangle) {
        const Triangle& t = topology.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge != MeshTopology::kNoEdge)
                balance[edge] += t[side] < t[(side + 1) % 3] ? 1 : -1;
        }
    });
    return std::all_of(balance.begin(), balance.end(), [](auto sum) { return sum == 0; });
}

}  // namespace tracked_mcf
