#include "filter_tracked_mcf/core/domain.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/disjoint_sets.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/marks.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

void check_selection(const TriangleMesh& mesh, const Selection& selection) {
    if (selection.empty()) return;
    if (selection.size() != mesh.triangles.size()) {
        throw InvalidParameter("The selection is of " + std::to_string(selection.size()) +
                               " triangles, but the mesh has " +
                               std::to_string(mesh.triangles.size()) + ".");
    }
    if (std::all_of(selection.begin(), selection.end(), [](auto flag) { return flag == 0; })) {
        throw InvalidMesh(
            "No face is selected; select the faces to smooth, or smooth the whole mesh.");
    }
}

/// The items whose flag is set, in their order.
template <class Items>
Items selected_of(const Items& items, const Selection& selection) {
    Items selected;
    serial_for(static_cast<std::int64_t>(items.size()), [&](std::int64_t i) {
        if (selection[i] != 0) selected.push_back(items[i]);
    });
    return selected;
}

/// Whether a triangle is so thin that its edges lie on each other, all but.
bool is_sliver(const TriangleMesh& mesh, const Triangle& t) {
    constexpr double thin = 1e-8;
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d edge = mesh.positions[t[(i + 1) % 3]] - mesh.positions[t[i]];
        longest = std::max(longest, edge.squaredNorm());
    }
    // Hardly any triangle is near the limit: most do without the root.
    const double squared = twice_vector_area(mesh, t).squaredNorm();
    const double limit = thin * longest;
    if (squared > 2 * limit * limit) return false;
    return std::sqrt(squared) <= limit;
}

bool bit(std::uint8_t mask, int i) {
    return ((mask >> i) & 1) != 0;
}

std::int64_t count_bits(const std::vector<std::uint8_t>& masks) {
    const auto size = static_cast<std::int64_t>(masks.size());
    return parallel_sum(size, std::int64_t{0}, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t count = 0;
        for (std::int64_t i = begin; i < end; ++i) {
            for (int side = 0; side < 3; ++side) count += bit(masks[i], side) ? 1 : 0;
        }
        return count;
    });
}

}  // namespace

double surface_area(const TriangleMesh& mesh, const Selection& selection) {
    if (selection.empty()) return surface_area(mesh);
    double twice = 0;
    serial_for(static_cast<std::int64_t>(selection.size()), [&](std::int64_t i) {
        if (selection[i] != 0) twice += twice_vector_area(mesh, mesh.triangles[i]).norm();
    });
    return 0.5 * twice;
}

Domain::Domain(const TriangleMesh& mesh, const Selection& selection, BoundaryCondition boundary)
    : mesh_(mesh) {
    check_selection(mesh, selection);
    topology_ = topology_of(mesh);
    std::vector<std::uint8_t> boundary_sides = boundary_edges(topology_);
    if (!selection.empty()) boundary_sides = selected_of(boundary_sides, selection);
    boundary_edge_count_ = count_bits(boundary_sides);
    held_edges_ = std::move(boundary_sides);
    if (boundary == BoundaryCondition::Free) held_edges_.assign(held_edges_.size(), 0);

    MeshTopology whole;
    if (!selection.empty()) {
        whole = std::move(topology_);
        take(whole, selection);
        hold_seam(whole, selection);
    }
    hold_across_slivers();
    hold_vertices(whole, selection);
    leave_slivers_out();
}

void Domain::take(const MeshTopology& whole, const Selection& selection) {
    part_ = TriangleMesh{copy_of(mesh_.positions), selected_of(mesh_.triangles, selection)};
    topology_.welded = whole.welded;
    topology_.triangles = selected_of(whole.triangles, selection);
    topology_.edges = selected_of(whole.edges, selection);
    topology_.edge_count = whole.edge_count;
}

/// Calls visit(triangle, side, edge) for the surface's sides that are edges.
template <class Visit>
void Domain::for_each_side(const Visit& visit) const {
    serial_for(static_cast<std::int64_t>(topology_.edges.size()), [&](std::int64_t triangle) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology_.edges[triangle][side];
            if (edge != MeshTopology::kNoEdge) visit(triangle, side, edge);
        }
    });
}

void Domain::hold_seam(const MeshTopology& whole, const Selection& selection) {
    std::vector<std::uint8_t> on_seam(static_cast<std::size_t>(whole.edge_count), 0);
    serial_for(static_cast<std::int64_t>(selection.size()), [&](std::int64_t triangle) {
        if (selection[triangle] != 0) return;
        for (const std::int32_t edge : whole.edges[triangle]) {
            if (edge != MeshTopology::kNoEdge) on_seam[edge] = 1;
        }
    });
    for_each_side([&](std::int64_t triangle, int side, std::int32_t edge) {
        if (on_seam[edge] != 0) held_edges_[triangle] |= static_cast<std::uint8_t>(1 << side);
    });
}

void Domain::hold_across_slivers() {
    slivers_.resize(surface().triangles.size());
    std::atomic<bool> any{false};
    parallel_for_rows(static_cast<std::int64_t>(slivers_.size()), [&](std::int32_t triangle) {
        slivers_[triangle] = is_sliver(surface(), surface().triangles[triangle]) ? 1 : 0;
        if (slivers_[triangle] != 0) any = true;
    });
    if (!any) return;
    // Edges that slivers join: if one is held, all are.
    DisjointSets joined(topology_.edge_count);
    serial_for(static_cast<std::int64_t>(slivers_.size()), [&](std::int64_t triangle) {
        if (slivers_[triangle] == 0) return;
        std::int32_t first = MeshTopology::kNoEdge;
        for (const std::int32_t edge : topology_.edges[triangle]) {
            if (edge == MeshTopology::kNoEdge) continue;
            if (first != MeshTopology::kNoEdge) joined.unite(first, edge);
            first = edge;
        }
    });
    const std::vector<std::int32_t> set_of = std::move(joined).representatives();
    std::vector<std::uint8_t> held(set_of.size(), 0);
    for_each_side([&](std::int64_t triangle, int side, std::int32_t edge) {
        if (bit(held_edges_[triangle], side)) held[set_of[edge]] = 1;
    });
    for_each_side([&](std::int64_t triangle, int side, std::int32_t edge) {
        if (held[set_of[edge]] != 0) held_edges_[triangle] |= static_cast<std::uint8_t>(1 << side);
    });
}

/// What slivers hold, their neighbours hold as well; and they know no conormal.
void Domain::leave_slivers_out() {
    if (std::none_of(slivers_.begin(), slivers_.end(), [](auto flag) { return flag != 0; })) return;
    std::vector<std::uint8_t> held_by_others(static_cast<std::size_t>(topology_.edge_count), 0);
    for_each_side([&](std::int64_t triangle, int side, std::int32_t edge) {
        if (bit(held_edges_[triangle], side) && slivers_[triangle] == 0) held_by_others[edge] = 1;
    });
    serial_for(static_cast<std::int64_t>(held_edges_.size()), [&](std::int64_t triangle) {
        const auto& edges = topology_.edges[triangle];
        const bool others_hold = std::any_of(edges.begin(), edges.end(), [&](std::int32_t edge) {
            return edge != MeshTopology::kNoEdge && held_by_others[edge] != 0;
        });
        if (slivers_[triangle] != 0 && others_hold) held_edges_[triangle] = 0;
    });
}

void Domain::hold_vertices(const MeshTopology& whole, const Selection& selection) {
    const std::vector<std::int32_t>& welded = topology_.welded;
    const auto count = static_cast<std::int64_t>(welded.size());
    Marks held(count);
    parallel_for_rows(static_cast<std::int64_t>(held_edges_.size()), [&](std::int32_t triangle) {
        for (int side = 0; side < 3; ++side) {
            if (!bit(held_edges_[triangle], side)) continue;
            held.set(topology_.triangles[triangle][side]);
            held.set(topology_.triangles[triangle][(side + 1) % 3]);
        }
    });
    parallel_for_rows(static_cast<std::int64_t>(selection.size()), [&](std::int32_t triangle) {
        if (selection[triangle] != 0) return;
        for (const std::int32_t vertex : whole.triangles[triangle]) held.set(vertex);
    });
    held_vertices_.resize(welded.size());
    parallel_for_rows(
        count, [&](std::int32_t vertex) { held_vertices_[vertex] = held[welded[vertex]] ? 1 : 0; });
}

bool Domain::holds_anything() const {
    return std::any_of(held_vertices_.begin(), held_vertices_.end(),
                       [](auto flag) { return flag != 0; });
}

}  // namespace tracked_mcf
