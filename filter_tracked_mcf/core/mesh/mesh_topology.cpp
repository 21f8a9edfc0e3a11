// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/cracks.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The sides of all triangles that join two vertices, grouped by their smaller vertex.
struct SidesByVertex {
    RawVector<std::int64_t> begin;   ///< per vertex, its first side; at last the number of sides
    RawVector<std::uint64_t> sides;  ///< in a group sorted by the larger vertex, then by triangle
};

/// A side is one number: its larger vertex, then 4 * triangle + side in the lower bits.
constexpr unsigned kSideBits = 33;
std::uint64_t larger_vertex(std::uint64_t side) {
    return side >> kSideBits;
}
std::int32_t triangle_of(std::uint64_t side) {
    return static_cast<std::int32_t>((side & ((std::uint64_t{1} << kSideBits) - 1)) >> 2U);
}
int index_in_triangle(std::uint64_t side) {
    return static_cast<int>(side & 3U);
}

/// Calls visit(smaller vertex, larger vertex, triangle, side) for all sides, in parallel.
template <class Visit>
void for_each_side(const RawVector<Triangle>& triangles, const Visit& visit) {
    parallel_for_rows(static_cast<std::int64_t>(triangles.size()), [&](std::int32_t triangle) {
        const Triangle& t = triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
            visit(a, b, triangle, side);
        }
    });
}

/// Returns the sides, not sorted yet. Sets the edges of sides that join a vertex to itself.
SidesByVertex group_sides(MeshTopology& topology) {
    std::vector<std::atomic<std::int32_t>> counts(topology.welded.size());
    for_each_side(topology.triangles,
                  [&](std::int32_t a, std::int32_t b, std::int32_t triangle, int side) {
                      if (a == b) {
                          topology.edges[triangle][side] = MeshTopology::kNoEdge;
                      } else {
                          counts[a].fetch_add(1, std::memory_order_relaxed);
                      }
                  });
    SidesByVertex groups;
    parallel_prefix_sum(
        static_cast<std::int64_t>(counts.size()),
        [&](std::int64_t vertex) { return counts[vertex].load(); }, groups.begin);
    groups.sides.resize(static_cast<std::size_t>(groups.begin.back()));
    for_each_side(topology.triangles,
                  [&](std::int32_t a, std::int32_t b, std::int32_t triangle, int side) {
                      if (a == b) return;
                      // Threads place the sides of a star in any order.
                      const std::int32_t left = counts[a].fetch_sub(1, std::memory_order_relaxed);
                      groups.sides[groups.begin[a] + left - 1] =
                          static_cast<std::uint64_t>(b) << kSideBits |
                          static_cast<std::uint64_t>(4 * std::int64_t{triangle} + side);
                  });
    return groups;
}

/// The sides of one edge.
struct EdgeSides {
    const std::uint64_t* begin;
    const std::uint64_t* end;
    const RawVector<Triangle>& triangles;

    /// Calls visit(triangle, side) for all of them.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const std::uint64_t* side = begin; side < end; ++side) {
            visit(triangle_of(*side), index_in_triangle(*side));
        }
    }

    /// Returns the third vertex of a side's triangle, or kNone if two of its vertices are equal.
    std::int32_t opposite(std::int32_t triangle, int side) const {
        const Triangle& t = triangles[triangle];
        const std::int32_t third = t[(side + 2) % 3];
        return third == t[side] || third == t[(side + 1) % 3] ? kNone : third;
    }

    /// Returns whether no two of the triangles have different third vertices.
    bool are_on_boundary() const {
        std::int32_t first = kNone;
        bool differ = false;
        for_each([&](std::int32_t triangle, int side) {
            const std::int32_t third = opposite(triangle, side);
            if (first == kNone) first = third;
            differ |= third != kNone && third != first;
        });
        return !differ;
    }

    std::int32_t imbalance() const {
        std::int32_t balance = 0;
        for_each([&](std::int32_t triangle, int side) {
            const Triangle& t = triangles[triangle];
            balance += t[side] < t[(side + 1) % 3] ? 1 : -1;
        });
        return std::abs(balance);
    }

    static constexpr std::int32_t kNone = -1;
};

/// Calls visit(sides) for every edge of a star, in order.
template <class Visit>
void for_each_edge_of(const SidesByVertex& groups, std::int64_t vertex,
                      const RawVector<Triangle>& triangles, const Visit& visit) {
    const std::uint64_t* const end = groups.sides.data() + groups.begin[vertex + 1];
    for (const std::uint64_t* side = groups.sides.data() + groups.begin[vertex]; side < end;) {
        const std::uint64_t* const first = side;
        while (side < end && larger_vertex(*side) == larger_vertex(*first)) ++side;
        visit(EdgeSides{first, side, triangles});
    }
}

/// Sorts a star and returns the number of its edges. A comparison sort of each small star is faster
/// than a radix sort of all sides.
std::int64_t sort_group(SidesByVertex& groups, std::int64_t vertex,
                        const RawVector<Triangle>& triangles) {
    std::sort(groups.sides.begin() + groups.begin[vertex],
              groups.sides.begin() + groups.begin[vertex + 1]);
    std::int64_t edges = 0;
    for_each_edge_of(groups, vertex, triangles, [&](const EdgeSides&) { ++edges; });
    return edges;
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
    find_edges(topology);
    topology.cracks = close_cracks(mesh, topology);
    return topology;
}

void find_edges(MeshTopology& topology) {
    topology.edges.resize(topology.triangles.size());
    SidesByVertex groups = group_sides(topology);
    std::vector<std::atomic<std::uint8_t>> boundary(topology.triangles.size());
    std::vector<std::int32_t> imbalances(
        static_cast<std::size_t>(chunk_count(static_cast<std::int64_t>(topology.welded.size()))));
    const auto edge_count = parallel_scan<std::int64_t>(
        static_cast<std::int64_t>(topology.welded.size()),
        [&](std::int64_t vertex) { return sort_group(groups, vertex, topology.triangles); },
        [&](std::int64_t begin, std::int64_t end, std::int64_t next_edge) {
            std::int32_t imbalance_here = 0;
            for (std::int64_t vertex = begin; vertex < end; ++vertex) {
                for_each_edge_of(groups, vertex, topology.triangles, [&](const EdgeSides& sides) {
                    const auto edge = static_cast<std::int32_t>(next_edge++);
                    sides.for_each([&](std::int32_t triangle, int side) {
                        topology.edges[triangle][side] = edge;
                    });
                    imbalance_here = std::max(imbalance_here, sides.imbalance());
                    if (!sides.are_on_boundary()) return;
                    sides.for_each([&](std::int32_t triangle, int side) {
                        if (sides.opposite(triangle, side) != EdgeSides::kNone)
                            boundary[triangle].fetch_or(static_cast<std::uint8_t>(1 << side));
                    });
                });
            }
            imbalances[begin / kChunkSize] = imbalance_here;
        });
    if (edge_count > std::numeric_limits<std::int32_t>::max()) {
        throw InvalidMesh("The mesh has more than 2147483647 edges; simplify it first.");
    }
    topology.edge_count = static_cast<std::int32_t>(edge_count);
    topology.boundary.assign(boundary.begin(), boundary.end());
    topology.imbalance = 0;
    for (const std::int32_t imbalance : imbalances)
        topology.imbalance = std::max(topology.imbalance, imbalance);
}

std::int64_t count_vertices(const MeshTopology& topology) {
    const auto count = static_cast<std::int64_t>(topology.welded.size());
    Marks welded(count);
    parallel_for_rows(count, [&](std::int32_t vertex) {
        if (topology.referenced[vertex] != 0) welded.set(topology.welded[vertex]);
    });
    return welded.count();
}

std::vector<std::uint8_t> one_copy_of_each_vertex(const MeshTopology& topology) {
    std::vector<std::uint8_t> is_known(topology.welded.size()), flags(topology.welded.size());
    for (std::size_t i = 0; i < flags.size(); ++i) {
        std::uint8_t& known = is_known[topology.welded[i]];
        if (topology.referenced[i] == 0 || known != 0) continue;
        known = 1;
        flags[i] = 1;
    }
    return flags;
}

std::int64_t genus_of(const MeshTopology& topology) {
    std::vector<std::int8_t> triangles_of(static_cast<std::size_t>(topology.edge_count), 0);
    DisjointSets sets(static_cast<std::int32_t>(topology.welded.size()));
    std::int64_t unions = 0, faces = 0;
    for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
        const Triangle& t = topology.triangles[i];
        const auto& edges = topology.edges[i];
        if (std::count(edges.begin(), edges.end(), MeshTopology::kNoEdge) > 0) continue;
        ++faces;
        for (int side = 0; side < 3; ++side) {
            if (++triangles_of[edges[side]] > 2) return 0;
            if (sets.unite(t[side], t[(side + 1) % 3])) ++unions;
        }
    }
    if (std::count(triangles_of.begin(), triangles_of.end(), 2) != topology.edge_count) return 0;
    const std::int64_t vertices = count_vertices(topology), components = vertices - unions;
    const std::int64_t characteristic = vertices - topology.edge_count + faces;
    return std::max<std::int64_t>(0, components - characteristic / 2);
}

}  // namespace tracked_mcf
