// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/patches.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/noise/stars.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

namespace tracked_mcf {

namespace {

constexpr int kRings = 3;
constexpr std::uint8_t kFar = kRings + 1;

/// Calls visit(a, b) for the ends of the edges that have one or more than two triangles.
template <class Visit>
void for_each_edge_without_two_sides(const MeshTopology& topology, const Visit& visit) {
    std::vector<std::uint8_t> triangles(static_cast<std::size_t>(topology.edge_count), 0);
    const auto for_each_side = [&](const auto& body) {
        for (std::size_t t = 0; t < topology.edges.size(); ++t) {
            for (int side = 0; side < 3; ++side) {
                const std::int32_t edge = topology.edges[t][side];
                if (edge != MeshTopology::kNoEdge) body(t, side, triangles[edge]);
            }
        }
    };
    for_each_side([](std::size_t /*t*/, int /*side*/, std::uint8_t& count) {
        if (count < 3) ++count;
    });
    for_each_side([&](std::size_t t, int side, std::uint8_t count) {
        if (count == 2 && !has_bit(topology.boundary[t], side)) return;
        visit(topology.triangles[t][side], topology.triangles[t][(side + 1) % 3]);
    });
}

bool has_three_vertices(const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// Returns, per vertex, its distance in edges from the vertices that move, at most kFar.
std::vector<std::uint8_t> rings_around(const MeshTopology& topology,
                                       const std::vector<std::uint8_t>& moves) {
    std::vector<std::uint8_t> rings(moves.size(), kFar);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        if (moves[i] != 0) rings[i] = 0;
    }
    for (std::uint8_t ring = 0; ring < kRings; ++ring) {
        for (const Triangle& t : topology.triangles) {
            if (std::min({rings[t[0]], rings[t[1]], rings[t[2]]}) != ring) continue;
            for (const std::int32_t vertex : t) {
                rings[vertex] = std::min(rings[vertex], static_cast<std::uint8_t>(ring + 1));
            }
        }
    }
    return rings;
}

/// Throws InvalidMesh if fewer than three vertices hold a connected part of those that move.
void check_seams(const Stars& stars, const std::vector<std::uint8_t>& rings) {
    DisjointSets parts(stars.count());
    const auto for_each_neighbour = [&](std::int32_t vertex, const auto& visit) {
        for (std::uint32_t k = stars.neighbour_begin[vertex]; k < stars.neighbour_begin[vertex + 1];
             ++k) {
            if (rings[stars.neighbours[k]] == 0) visit(stars.neighbours[k]);
        }
    };
    for (std::int32_t i = 0; i < stars.count(); ++i) {
        if (rings[i] == 0)
            for_each_neighbour(i, [&](std::int32_t other) { parts.unite(i, other); });
    }
    std::vector<std::int32_t> held(rings.size(), 0);  // per representative
    std::vector<std::int32_t> touched;
    for (std::int32_t i = 0; i < stars.count(); ++i) {
        if (rings[i] != 1) continue;
        touched.clear();
        for_each_neighbour(i, [&](std::int32_t other) { touched.push_back(parts.find(other)); });
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const std::int32_t part : touched) ++held[part];
    }
    for (std::int32_t i = 0; i < stars.count(); ++i) {
        if (rings[i] != 0 || parts.find(i) != i || held[i] >= 3) continue;
        throw InvalidMesh(
            "Nothing holds a part of the selection: it is a closed surface, or touches others in "
            "one edge or vertex. Deselect this part.");
    }
}

}  // namespace

std::vector<std::uint8_t> inner_vertices(const MeshTopology& topology, const Selection& selection) {
    std::vector<std::uint8_t> moves(topology.welded.size(), 0);
    for (const bool selected : {true, false}) {
        for (std::size_t i = 0; i < selection.size(); ++i) {
            if ((selection[i] != 0) != selected) continue;
            if (selected && !has_three_vertices(topology.triangles[i])) continue;
            for (const std::int32_t vertex : topology.triangles[i])
                moves[vertex] = selected ? 1 : 0;
        }
    }
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(topology.boundary[t], side)) continue;
            moves[topology.triangles[t][side]] = moves[topology.triangles[t][(side + 1) % 3]] = 0;
        }
    }
    return moves;
}

std::vector<Patch> patches_of(const MeshTopology& topology,
                              const std::vector<std::uint8_t>& moves) {
    const std::vector<std::uint8_t> rings = rings_around(topology, moves);
    const auto ring_of = [&](const Triangle& t) {
        return std::min({rings[t[0]], rings[t[1]], rings[t[2]]});
    };
    // The triangles of an equation, and which vertices it joins.
    RawVector<Triangle> triangles;
    DisjointSets sets(static_cast<std::int32_t>(rings.size()));
    for (const Triangle& t : topology.triangles) {
        if (ring_of(t) >= kRings || !has_three_vertices(t)) continue;
        triangles.push_back(t);
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            if (rings[a] <= 1 && rings[b] <= 1) sets.unite(a, b);
        }
    }
    std::vector<std::uint8_t> has_normal(rings.size(), 1);
    for_each_edge_without_two_sides(
        topology, [&](std::int32_t a, std::int32_t b) { has_normal[a] = has_normal[b] = 0; });

    const Stars stars(std::move(triangles), static_cast<std::int32_t>(rings.size()));
    check_seams(stars, rings);
    std::vector<Patch> patches;
    std::vector<std::int32_t> patch_of(rings.size(), -1);  // per representative
    for (std::int32_t i = 0; i < stars.count(); ++i) {
        if (moves[i] == 0) continue;
        std::int32_t& patch = patch_of[sets.find(i)];
        if (patch < 0) {
            patch = static_cast<std::int32_t>(patches.size());
            patches.emplace_back();
        }
        patches[patch].vertices.push_back(i);
    }
    std::vector<std::int32_t> numbers(rings.size(), -1);  // those of one patch at a time
    for (Patch& patch : patches) {
        std::vector<std::int32_t>& vertices = patch.vertices;
        patch.moving = static_cast<std::int32_t>(vertices.size());
        for (std::int32_t i = 0; i < patch.moving; ++i) numbers[vertices[i]] = i;
        std::size_t begin = 0;
        for (int ring = 0; ring < kRings; ++ring) {
            const std::size_t end = vertices.size();
            patch.held = patch.inner;
            patch.inner = static_cast<std::int32_t>(end);
            for (; begin < end; ++begin) {
                const std::int32_t vertex = vertices[begin];
                for (std::uint32_t k = stars.neighbour_begin[vertex];
                     k < stars.neighbour_begin[vertex + 1]; ++k) {
                    const std::int32_t neighbour = stars.neighbours[k];
                    if (numbers[neighbour] >= 0) continue;
                    numbers[neighbour] = static_cast<std::int32_t>(vertices.size());
                    vertices.push_back(neighbour);
                }
            }
        }
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            patch.has_normal.push_back(has_normal[vertices[i]]);
            if (static_cast<std::int32_t>(i) >= patch.inner) continue;
            for_each_corner(stars, vertices[i], [&](std::uint32_t t, std::uint32_t /*corner*/) {
                const Triangle& old = stars.triangles[t];
                const Triangle renamed = {numbers[old[0]], numbers[old[1]], numbers[old[2]]};
                const auto first = std::min({renamed[0], renamed[1], renamed[2]});
                if (first == static_cast<std::int32_t>(i)) patch.triangles.push_back(renamed);
            });
        }
        for (const std::int32_t vertex : vertices) numbers[vertex] = -1;
    }
    return patches;
}

}  // namespace tracked_mcf
