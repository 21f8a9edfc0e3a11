// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/patches.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

namespace tracked_mcf {

namespace {

constexpr int kRings = 3;

/// The vertices that move and the rings around them, with numbers of their own.
struct Neighbourhood {
    std::vector<std::int32_t> vertices;        ///< of the surface, ring by ring
    std::array<std::int32_t, kRings + 1> end;  ///< of those that move, and of each ring
    std::vector<Triangle> triangles;           ///< with a vertex before the last ring

    std::int32_t count() const { return end.back(); }
    bool moves(std::int32_t number) const { return number < end[0]; }
    int ring(std::int32_t number) const {
        return static_cast<int>(std::upper_bound(end.begin(), end.end(), number) - end.begin());
    }
};

Neighbourhood neighbourhood_of(const std::vector<std::uint8_t>& moves, const Stars& stars) {
    Neighbourhood near;
    for (std::int32_t i = 0; i < stars.count(); ++i) {
        if (moves[i] != 0) near.vertices.push_back(i);
    }
    near.end[0] = static_cast<std::int32_t>(near.vertices.size());
    std::vector<std::int32_t> numbers(moves.size(), -1);
    std::int32_t next = 0;
    for (int ring = 0;; ++ring) {
        std::vector<std::int32_t> outer;
        for (; next < near.end[ring]; ++next) numbers[near.vertices[next]] = next;
        if (ring == kRings) break;
        for (std::int32_t i = ring == 0 ? 0 : near.end[ring - 1]; i < near.end[ring]; ++i) {
            const std::int32_t vertex = near.vertices[i];
            for (auto k = stars.neighbour_begin[vertex]; k < stars.neighbour_begin[vertex + 1]; ++k)
                if (numbers[stars.neighbours[k]] < 0) outer.push_back(stars.neighbours[k]);
        }
        std::sort(outer.begin(), outer.end());
        outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
        near.vertices.insert(near.vertices.end(), outer.begin(), outer.end());
        near.end[ring + 1] = static_cast<std::int32_t>(near.vertices.size());
    }
    for (std::int32_t i = 0; i < near.end[kRings - 1]; ++i) {
        for_each_corner(stars, near.vertices[i], [&](std::uint32_t triangle, std::uint32_t) {
            const Triangle& t = stars.triangles[triangle];
            const Triangle renamed = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
            if (*std::min_element(renamed.begin(), renamed.end()) == i)
                near.triangles.push_back(renamed);
        });
    }
    return near;
}

/// Returns whether all edges of a vertex have two triangles.
bool has_whole_star(const Stars& stars, std::int32_t vertex) {
    const std::uint32_t first = stars.neighbour_begin[vertex];
    std::vector<int> triangles(stars.neighbour_begin[vertex + 1] - first, 0);  // per edge
    for (auto i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1]; ++i) {
        for (const std::uint32_t place : stars.places[i]) ++triangles[place - first];
    }
    return std::all_of(triangles.begin(), triangles.end(), [](int count) { return count == 2; });
}

/// Throws InvalidMesh if fewer than three vertices hold a connected part of those that move.
void check_seams(const Neighbourhood& near) {
    DisjointSets parts(near.count());
    const auto for_each_edge = [&](const auto& visit) {
        for (const Triangle& t : near.triangles) {
            for (int k = 0; k < 9; ++k) {
                if (near.moves(t[k / 3]) && k / 3 != k % 3) visit(t[k / 3], t[k % 3]);
            }
        }
    };
    for_each_edge([&](std::int32_t a, std::int32_t b) {
        if (near.moves(b)) parts.unite(a, b);
    });
    std::map<std::int32_t, std::set<std::int32_t>> seams;
    for (std::int32_t i = 0; i < near.end[0]; ++i) seams[parts.find(i)];
    for_each_edge([&](std::int32_t a, std::int32_t b) {
        if (!near.moves(b)) seams[parts.find(a)].insert(b);
    });
    for (const auto& [part, seam] : seams) {
        if (seam.size() >= 3) continue;
        throw InvalidMesh(
            "Nothing holds a part of the selection: it is a closed surface, or touches others in "
            "one edge or vertex. Deselect this part.");
    }
}

}  // namespace

std::vector<Patch> patches_of(const Stars& stars, const std::vector<std::uint8_t>& moves) {
    const Neighbourhood near = neighbourhood_of(moves, stars);
    check_seams(near);
    DisjointSets sets(near.count());
    for (const auto& [a, b, c] : near.triangles) sets.unite(a, b), sets.unite(b, c);

    std::vector<Patch> patches;
    std::vector<std::int32_t> numbers(near.vertices.size()), patch_of(near.vertices.size(), -1);
    for (std::int32_t i = 0; i < near.count(); ++i) {
        std::int32_t& number = patch_of[sets.find(i)];
        if (number < 0) {
            number = static_cast<std::int32_t>(patches.size());
            patches.emplace_back();
        }
        Patch& patch = patches[number];
        patch.vertices.push_back(near.vertices[i]);
        patch.has_normal.push_back(has_whole_star(stars, near.vertices[i]) ? 1 : 0);
        const auto end = static_cast<std::int32_t>(patch.vertices.size());
        numbers[i] = end - 1;
        if (near.ring(i) <= 0) patch.moving = end;
        if (near.ring(i) <= 1) patch.held = end;
        if (near.ring(i) <= 2) patch.inner = end;
    }
    for (const Triangle& t : near.triangles) {
        patches[patch_of[sets.find(t[0])]].triangles.push_back(
            {numbers[t[0]], numbers[t[1]], numbers[t[2]]});
    }
    return patches;
}

}  // namespace tracked_mcf
