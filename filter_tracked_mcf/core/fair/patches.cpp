// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/patches.h"

#include <algorithm>
#include <map>
#include <set>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

namespace tracked_mcf {

namespace {

constexpr std::uint8_t kRings = 3;

/// Per vertex, its distance in edges from the vertices that move, at most kRings + 1.
using Rings = std::vector<std::uint8_t>;

/// Calls visit(t, triangle) for the triangles that have three vertices. The others are no part of
/// the surface: they link nothing.
template <class Visit>
void for_each_proper_triangle(const MeshTopology& topology, const Visit& visit) {
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        if (has_three_vertices(topology.triangles[t])) visit(t, topology.triangles[t]);
    }
}

/// Calls visit(a, b, sides) for each side of a triangle: its vertices, and how many triangles have
/// the edge; 1 on the boundary.
template <class Visit>
void for_each_side(const MeshTopology& topology, const Visit& visit) {
    std::vector<std::uint8_t> sides(static_cast<std::size_t>(topology.edge_count), 0);
    for_each_proper_triangle(topology, [&](std::size_t t, const Triangle&) {
        for (const std::int32_t edge : topology.edges[t])
            sides[edge] = static_cast<std::uint8_t>(std::min(sides[edge] + 1, 3));
    });
    for_each_proper_triangle(topology, [&](std::size_t t, const Triangle& triangle) {
        for (int k = 0; k < 3; ++k) {
            visit(triangle[k], triangle[(k + 1) % 3],
                  has_bit(topology.boundary[t], k) ? 1 : int{sides[topology.edges[t][k]]});
        }
    });
}

/// Throws InvalidMesh if fewer than three vertices hold a connected part of those that move.
void check_seams(const MeshTopology& topology, const Rings& rings) {
    DisjointSets parts(static_cast<std::int32_t>(rings.size()));
    for_each_proper_triangle(topology, [&](std::size_t, const Triangle& t) {
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            if (rings[a] == 0 && rings[b] == 0) parts.unite(a, b);
        }
    });
    std::map<std::int32_t, std::set<std::int32_t>> seams;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        if (rings[i] == 0) seams[parts.find(static_cast<std::int32_t>(i))];
    }
    for_each_proper_triangle(topology, [&](std::size_t, const Triangle& t) {
        for (int k = 0; k < 9; ++k) {
            const std::int32_t a = t[k / 3], b = t[k % 3];
            if (rings[a] == 0 && rings[b] == 1) seams[parts.find(a)].insert(b);
        }
    });
    for (const auto& [part, seam] : seams) {
        if (seam.size() >= 3) continue;
        throw InvalidMesh(
            "Nothing holds a part of the selection: it is a closed surface, or touches others in "
            "one edge or vertex. Deselect this part.");
    }
}

/// Returns the rings around the inner vertices of the selection.
Rings rings_around_inner_vertices(const MeshTopology& topology, const Selection& selection) {
    Rings rings(topology.welded.size(), kRings + 1);
    for (const bool selected : {true, false}) {
        for (std::size_t i = 0; i < selection.size(); ++i) {
            const Triangle& t = topology.triangles[i];
            if ((selection[i] != 0) != selected || (selected && !has_three_vertices(t))) continue;
            for (const std::int32_t vertex : t) rings[vertex] = selected ? 0 : kRings + 1;
        }
    }
    for_each_side(topology, [&](std::int32_t a, std::int32_t b, int sides) {
        if (sides == 1) rings[a] = rings[b] = kRings + 1;
    });
    for (std::uint8_t ring = 0; ring < kRings; ++ring) {
        const auto next = static_cast<std::uint8_t>(ring + 1);
        for_each_proper_triangle(topology, [&](std::size_t, const Triangle& t) {
            if (std::min({rings[t[0]], rings[t[1]], rings[t[2]]}) != ring) return;
            for (const std::int32_t vertex : t) rings[vertex] = std::min(rings[vertex], next);
        });
    }
    return rings;
}

}  // namespace

std::vector<Patch> patches_of(const MeshTopology& topology, const Selection& selection) {
    const Rings rings = rings_around_inner_vertices(topology, selection);
    check_seams(topology, rings);
    const auto count = static_cast<std::int32_t>(rings.size());
    DisjointSets sets(count);
    const auto is_near = [&](const Triangle& t) {
        return std::min({rings[t[0]], rings[t[1]], rings[t[2]]}) < kRings;
    };
    for_each_proper_triangle(topology, [&](std::size_t, const Triangle& t) {
        if (is_near(t)) sets.unite(t[0], t[1]), sets.unite(t[1], t[2]);
    });
    std::vector<std::uint8_t> has_normal(rings.size(), 1);
    for_each_side(topology, [&](std::int32_t a, std::int32_t b, int sides) {
        if (sides != 2) has_normal[a] = has_normal[b] = 0;
    });

    std::vector<Patch> patches;
    std::vector<std::int32_t> numbers(rings.size()), patch_of(rings.size(), -1);
    for (int ring = 0; ring <= kRings; ++ring) {
        for (std::int32_t i = 0; i < count; ++i) {
            if (rings[i] != ring) continue;
            std::int32_t& patch = patch_of[sets.find(i)];
            if (patch < 0) {
                patch = static_cast<std::int32_t>(patches.size());
                patches.emplace_back();
            }
            numbers[i] = static_cast<std::int32_t>(patches[patch].vertices.size());
            patches[patch].vertices.push_back(i);
            patches[patch].has_normal.push_back(has_normal[i]);
        }
        for (Patch& patch : patches) {
            const auto end = static_cast<std::int32_t>(patch.vertices.size());
            if (ring == 0) patch.moving = end;
            if (ring == 1) patch.held = end;
            if (ring == 2) patch.inner = end;
        }
    }
    for_each_proper_triangle(topology, [&](std::size_t, const Triangle& t) {
        if (!is_near(t)) return;
        patches[patch_of[sets.find(t[0])]].triangles.push_back(
            {numbers[t[0]], numbers[t[1]], numbers[t[2]]});
    });
    return patches;
}

}  // namespace tracked_mcf
