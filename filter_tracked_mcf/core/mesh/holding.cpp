// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/holding.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// A triangle is a sliver if its area is at most this times its longest edge squared.
constexpr double kSliver = 5e-9;

/// Flags of the edges of a surface, by their entries in Stars::neighbours at the smaller vertex,
/// and of the vertices at their ends.
class EdgeMarks {
public:
    explicit EdgeMarks(const Stars& stars)
        : stars_(stars),
          edges_(static_cast<std::int64_t>(stars.neighbours.size())),
          ends_(stars.count()) {}

    /// Marks the edge between two vertices, if there is one.
    void set(std::int32_t a, std::int32_t b) {
        if (!stars_.are_joined(a, b)) return;
        edges_.set(edge_of(a, b));
        ends_.set(a);
        ends_.set(b);
    }
    /// Returns whether two vertices that an edge joins have a mark on it.
    bool has(std::int32_t a, std::int32_t b) const {
        return is_end(a) && is_end(b) && edges_[edge_of(a, b)];
    }
    bool is_end(std::int32_t vertex) const { return ends_[vertex]; }
    std::uint32_t edge_of(std::int32_t a, std::int32_t b) const {
        return stars_.entry(std::min(a, b), std::max(a, b));
    }

private:
    const Stars& stars_;
    Marks edges_, ends_;
};

/// Calls visit(triangle, side, a, b) for all sides of the triangles, from a to b, in parallel for
/// the triangles.
template <class Visit>
void for_each_side(const RawVector<Triangle>& triangles, const Visit& visit) {
    parallel_for_rows(static_cast<std::int64_t>(triangles.size()), [&](std::int32_t triangle) {
        const Triangle& t = triangles[triangle];
        for (int side = 0; side < 3; ++side) visit(triangle, side, t[side], t[(side + 1) % 3]);
    });
}

/// Marks the edges that the surface shares with triangles that are not selected. Triangles without
/// three vertices close no rim.
void find_seam(const Surface& surface, const TriangleMesh& mesh, const Selection& selection,
               EdgeMarks& seam) {
    parallel_for_rows(static_cast<std::int64_t>(selection.size()), [&](std::int32_t triangle) {
        if (selection[triangle] != 0) return;
        const Triangle& t = mesh.triangles[triangle];
        const Triangle here = {surface.vertices[t[0]], surface.vertices[t[1]],
                               surface.vertices[t[2]]};
        for (int side = 0; side < 3; ++side) {
            const std::int32_t a = here[side], b = here[(side + 1) % 3], c = here[(side + 2) % 3];
            if (a >= 0 && b >= 0 && a != b && c != a && c != b) seam.set(a, b);
        }
    });
}

/// Returns the slivers among the triangles.
std::vector<std::int32_t> slivers_of(const Surface& surface) {
    const RawVector<Triangle>& triangles = surface.stars.triangles;
    return parallel_collect_if<std::int32_t>(
        static_cast<std::int64_t>(triangles.size()),
        [&](std::int64_t i) {
            return is_thin(corners_of(surface.positions, triangles[i]), kSliver);
        },
        [](std::int64_t i) { return static_cast<std::int32_t>(i); });
}

/// Holds all edges of slivers that have a held one. Chains of slivers pass this on.
void hold_across(const std::vector<std::int32_t>& slivers, const Stars& stars, EdgeMarks& held) {
    const auto count = static_cast<std::int32_t>(slivers.size());
    const auto for_each_side_of = [&](std::int32_t sliver, const auto& visit) {
        const Triangle& t = stars.triangles[slivers[sliver]];
        for (int side = 0; side < 3; ++side) visit(t[side], t[(side + 1) % 3]);
    };
    std::vector<std::pair<std::uint32_t, std::int32_t>> by_edge;  // edge, sliver
    for (std::int32_t i = 0; i < count; ++i) {
        for_each_side_of(i, [&](std::int32_t a, std::int32_t b) {
            by_edge.emplace_back(held.edge_of(a, b), i);
        });
    }
    std::sort(by_edge.begin(), by_edge.end());
    DisjointSets chains(count);
    for (std::size_t i = 1; i < by_edge.size(); ++i) {
        if (by_edge[i].first == by_edge[i - 1].first)
            chains.unite(by_edge[i].second, by_edge[i - 1].second);
    }
    std::vector<std::uint8_t> is_held(slivers.size(), 0);
    for (std::int32_t i = 0; i < count; ++i) {
        for_each_side_of(i, [&](std::int32_t a, std::int32_t b) {
            if (held.has(a, b)) is_held[chains.find(i)] = 1;
        });
    }
    for (std::int32_t i = 0; i < count; ++i) {
        if (is_held[chains.find(i)] == 0) continue;
        for_each_side_of(i, [&](std::int32_t a, std::int32_t b) { held.set(a, b); });
    }
}

/// Returns flags of the held sides of each triangle. A sliver has no reliable conormal, so it has
/// no flags if one of its held edges has a triangle that is none.
std::vector<std::uint8_t> sides_of(const EdgeMarks& held, const std::vector<std::int32_t>& slivers,
                                   const Stars& stars) {
    std::vector<std::uint8_t> flags(stars.triangles.size());
    for_each_side(stars.triangles, [&](std::int32_t t, int side, std::int32_t a, std::int32_t b) {
        if (held.has(a, b))
            flags[t] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(side));
    });
    if (slivers.empty()) return flags;
    EdgeMarks by_others(stars);
    for_each_side(stars.triangles,
                  [&](std::int32_t t, int /*side*/, std::int32_t a, std::int32_t b) {
                      if (held.has(a, b) && !std::binary_search(slivers.begin(), slivers.end(), t))
                          by_others.set(a, b);
                  });
    for (const std::int32_t sliver : slivers) {
        const Triangle& t = stars.triangles[sliver];
        for (int side = 0; side < 3; ++side) {
            if (by_others.has(t[side], t[(side + 1) % 3])) flags[sliver] = 0;
        }
    }
    return flags;
}

}  // namespace

void hold_seam(Surface& surface, const TriangleMesh& mesh, const Selection& selection) {
    Marks touched(surface.stars.count());
    parallel_for_rows(static_cast<std::int64_t>(selection.size()), [&](std::int32_t triangle) {
        if (selection[triangle] != 0) return;
        for (const std::int32_t vertex : mesh.triangles[triangle]) {
            if (surface.vertices[vertex] >= 0) touched.set(surface.vertices[vertex]);
        }
    });
    surface.held = touched.flags();
}

void hold_vertices(Surface& surface, const TriangleMesh& mesh, const Selection& selection,
                   BoundaryCondition boundary) {
    const Stars& stars = surface.stars;
    hold_seam(surface, mesh, selection);
    EdgeMarks held(stars);
    find_seam(surface, mesh, selection, held);
    surface.counts.boundary_edges =
        parallel_count(static_cast<std::int64_t>(stars.rim_sides.size()), [&](std::int64_t i) {
            const Triangle& t = stars.triangles[i / 3];
            return stars.rim_sides[i] != 0 && !held.has(t[i % 3], t[(i + 1) % 3]);
        });
    const bool holds_rim = stars.has_rim() && boundary != BoundaryCondition::Free;
    if (holds_rim) {
        for_each_side(stars.triangles,
                      [&](std::int32_t t, int side, std::int32_t a, std::int32_t b) {
                          if (stars.rim_sides[3 * std::int64_t{t} + side] != 0) held.set(a, b);
                      });
    }
    if (holds_rim || !selection.empty()) {
        const std::vector<std::int32_t> slivers = slivers_of(surface);
        hold_across(slivers, stars, held);
        surface.held_sides = sides_of(held, slivers, stars);
    }
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const bool is_held =
            held.is_end(vertex) || (!surface.strengths.empty() && surface.strengths[vertex] == 0);
        if (is_held) surface.held[vertex] = 1;
    });
}

}  // namespace tracked_mcf
