// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/domain.h"

#include <algorithm>
#include <bitset>
#include <numeric>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// A triangle is a sliver if its area is at most this times its longest edge squared.
constexpr double kSliver = 5e-9;

bool any_set(const std::vector<std::uint8_t>& flags) {
    return std::any_of(flags.begin(), flags.end(), [](auto flag) { return flag != 0; });
}

/// Returns the items of the selected triangles.
template <class Items>
Items selected_of(const Items& items, const Selection& selection) {
    Items selected;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (selection[i] != 0) selected.push_back(items[i]);
    }
    return selected;
}

/// Returns, per triangle, flags of the sides with an unselected triangle.
std::vector<std::uint8_t> sides_of_unselected(const MeshTopology& topology,
                                              const Selection& selection) {
    Marks unselected(topology.edge_count);
    for_each_edge(topology, [&](std::int32_t triangle, int /*side*/, std::int32_t edge) {
        if (selection[triangle] == 0) unselected.set(edge);
    });
    std::vector<std::uint8_t> sides(selection.size(), 0);
    for_each_edge(topology, [&](std::int32_t triangle, int side, std::int32_t edge) {
        if (unselected[edge]) sides[triangle] |= static_cast<std::uint8_t>(1 << side);
    });
    return sides;
}

std::int64_t count_flags(const std::vector<std::uint8_t>& sides) {
    return std::accumulate(sides.begin(), sides.end(), std::int64_t{0}, [](auto sum, auto flags) {
        return sum + static_cast<std::int64_t>(std::bitset<3>(flags).count());
    });
}

std::vector<std::uint8_t> find_slivers(const SurfaceView& surface) {
    std::vector<std::uint8_t> slivers(surface.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(slivers.size()), [&](std::int32_t triangle) {
        const auto corners = corners_of(surface.positions, surface.triangles[triangle]);
        slivers[triangle] = is_thin(corners, kSliver) ? 1 : 0;
    });
    return slivers;
}

}  // namespace

/// Constrains every side of the surface's triangles for which is_constrained(edge).
template <class IsConstrained>
void Domain::constrain_edges(const IsConstrained& is_constrained) {
    for_each_edge(topology_, [&](std::int32_t triangle, int side, std::int32_t edge) {
        if (is_constrained(edge))
            constrained_edges_[triangle] |= static_cast<std::uint8_t>(1 << side);
    });
}

Domain::Domain(const TriangleMesh& mesh, const Inputs& inputs, BoundaryCondition boundary)
    : mesh_(mesh), strength_(inputs.strength), selection_(inputs.selection) {
    topology_ = topology_of(mesh);
    if (has_strengths()) leave_zero_strength_out();
    std::vector<std::uint8_t> boundary_sides = topology_.boundary;
    constrained_edges_.assign(topology_.triangles.size(), 0);
    if (!selection_.empty()) {
        boundary_sides = selected_of(boundary_sides, selection_);
        constrained_edges_ = selected_of(sides_of_unselected(topology_, selection_), selection_);
        restrict_to_selection();
    }
    boundary_edge_count_ = count_flags(boundary_sides);
    if (boundary != BoundaryCondition::Free) {
        for (std::size_t i = 0; i < boundary_sides.size(); ++i)
            constrained_edges_[i] |= boundary_sides[i];
    }

    std::vector<std::uint8_t> slivers;
    if (any_set(constrained_edges_)) slivers = find_slivers(surface());
    const bool any_slivers = any_set(slivers);
    if (any_slivers) constrain_across_slivers(slivers);
    constrain_vertices();
    if (any_slivers) leave_slivers_out(slivers);
}

void Domain::leave_zero_strength_out() {
    const auto is_zero = [&](std::int32_t vertex) { return strength(vertex) == 0; };
    selection_.resize(mesh_.triangles.size(), 1);
    for (std::size_t i = 0; i < selection_.size(); ++i) {
        const Triangle& t = mesh_.triangles[i];
        if (selection_[i] == 0 || !std::all_of(t.begin(), t.end(), is_zero)) continue;
        selection_[i] = 0;
        ++zero_strength_count_;
    }
    if (!any_set(selection_)) {
        throw InvalidMesh(
            "Nothing can move: all vertices of the faces to smooth have strength 0. Give some a "
            "larger one.");
    }
}

void Domain::restrict_to_selection() {
    selected_triangles_ =
        std::make_unique<std::vector<Triangle>>(selected_of(mesh_.triangles, selection_));
    topology_.referenced = referenced_vertices(surface());
    topology_.triangles = selected_of(topology_.triangles, selection_);
    find_edges(topology_);
}

/// A sliver's edges lie on each other: if one of them is constrained, all of them are. Chains of
/// slivers pass constraints on.
void Domain::constrain_across_slivers(const std::vector<std::uint8_t>& slivers) {
    ConcurrentSets joined(topology_.edge_count);
    for (std::size_t triangle = 0; triangle < slivers.size(); ++triangle) {
        if (slivers[triangle] == 0) continue;
        std::int32_t previous = MeshTopology::kNoEdge;
        for (const std::int32_t edge : topology_.edges[triangle]) {
            if (edge == MeshTopology::kNoEdge) continue;
            if (previous != MeshTopology::kNoEdge) joined.unite(previous, edge);
            previous = edge;
        }
    }
    Marks constrained(topology_.edge_count);
    for_each_edge(topology_, [&](std::int32_t triangle, int side, std::int32_t edge) {
        if (has_bit(constrained_edges_[triangle], side)) constrained.set(joined.find(edge));
    });
    constrain_edges([&](std::int32_t edge) { return constrained[joined.find(edge)]; });
}

void Domain::constrain_vertices() {
    const std::vector<std::int32_t>& welded = topology_.welded;
    const auto count = static_cast<std::int64_t>(welded.size());
    Marks constrained(count);
    parallel_for_rows(static_cast<std::int64_t>(constrained_edges_.size()),
                      [&](std::int32_t triangle) {
                          for (int side = 0; side < 3; ++side) {
                              if (!has_bit(constrained_edges_[triangle], side)) continue;
                              constrained.set(topology_.triangles[triangle][side]);
                              constrained.set(topology_.triangles[triangle][(side + 1) % 3]);
                          }
                      });
    parallel_for_rows(static_cast<std::int64_t>(selection_.size()), [&](std::int32_t triangle) {
        if (selection_[triangle] != 0) return;
        for (const std::int32_t vertex : mesh_.triangles[triangle]) constrained.set(welded[vertex]);
    });
    constrained_vertices_.resize(welded.size());
    parallel_for_rows(count, [&](std::int32_t vertex) {
        const bool stays = constrained[welded[vertex]] || strength(vertex) == 0;
        constrained_vertices_[vertex] = stays ? 1 : 0;
    });
}

/// A sliver has no reliable conormal, so its neighbours with area take over: where they constrain
/// one of its edges, the sliver constrains none.
void Domain::leave_slivers_out(const std::vector<std::uint8_t>& slivers) {
    Marks by_neighbours(topology_.edge_count);
    for_each_edge(topology_, [&](std::int32_t triangle, int side, std::int32_t edge) {
        if (has_bit(constrained_edges_[triangle], side) && slivers[triangle] == 0)
            by_neighbours.set(edge);
    });
    for_each_edge(topology_, [&](std::int32_t triangle, int /*side*/, std::int32_t edge) {
        if (slivers[triangle] != 0 && by_neighbours[edge]) constrained_edges_[triangle] = 0;
    });
}

bool Domain::has_constraints() const {
    return any_set(constrained_vertices_);
}

std::pair<std::int64_t, std::int64_t> Domain::vertex_counts() const {
    const std::vector<std::uint8_t> one_copies = one_copy_of_each_vertex(topology_);
    std::int64_t all = 0, constrained = 0;
    for (std::size_t i = 0; i < one_copies.size(); ++i) {
        all += one_copies[i];
        if (one_copies[i] != 0 && constrained_vertices_[i] != 0) ++constrained;
    }
    return {all, constrained};
}

}  // namespace tracked_mcf
