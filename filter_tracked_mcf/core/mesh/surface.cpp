// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/cracks.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/holding.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/orientation.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

using Numbers = std::vector<std::int32_t>;

constexpr std::int32_t kNoVertex = -1;

bool has_none(const Triangle& t) {
    return *std::min_element(t.begin(), t.end()) == kNoVertex;
}

/// Vertices are put in the order of a grid of 2 to this power cells a side.
constexpr int kDepthOfOrder = 20;
/// Of vertices in one cell, so many are sorted by their coordinates; more have a grid of their own.
constexpr std::int64_t kMostInCell = 256;

template <class Body>
void for_each_number(const Numbers& numbers, const Body& body) {
    parallel_for_rows(static_cast<std::int64_t>(numbers.size()), body);
}

/// A vertex of the mesh, as `value`; its key is the cell in which it lies.
using PlacedVertices = RawVector<KeyValue>;

/// Returns the vertices of the mesh that represent others in selected triangles with three
/// different vertices. `welded` has the representative of each vertex, or kNoVertex.
PlacedVertices used_vertices(const TriangleMesh& mesh, const Selection& selection,
                             const Numbers& welded) {
    Marks used(static_cast<std::int64_t>(welded.size()));
    parallel_for_rows(static_cast<std::int64_t>(mesh.triangles.size()), [&](std::int32_t i) {
        if (!selection.empty() && selection[i] == 0) return;
        const Triangle& t = mesh.triangles[i];
        const Triangle representatives = {welded[t[0]], welded[t[1]], welded[t[2]]};
        if (!has_three_vertices(representatives) || has_none(representatives)) return;
        for (const std::int32_t vertex : representatives) used.set(vertex);
    });
    return parallel_collect_if<KeyValue, PlacedVertices>(
        static_cast<std::int64_t>(welded.size()), [&](std::int64_t i) { return used[i]; },
        [](std::int64_t i) {
            return KeyValue{0, static_cast<std::uint64_t>(i)};
        });
}

Eigen::AlignedBox3d box_around(const Positions& positions, const PlacedVertices& vertices) {
    Eigen::AlignedBox3d box;
    for (const KeyValue& vertex : vertices) box.extend(positions[vertex.value]);
    return box;
}

/// Sorts vertices at different places along Morton's curve in their box.
void sort_along_curve(const Positions& positions, const Eigen::AlignedBox3d& box,
                      PlacedVertices& vertices) {
    const Grid grid = with_depth(cube_around(box), kDepthOfOrder);
    const auto count = static_cast<std::int64_t>(vertices.size());
    parallel_for_rows(count, [&](std::int32_t i) {
        const Eigen::Vector3d at = grid.to_grid(positions[vertices[i].value]);
        vertices[i].key = morton_code(at.array().floor().cast<std::int32_t>().matrix());
    });
    sort_by_key(vertices);
    const auto begins = runs_by(vertices, [](const KeyValue& vertex) { return vertex.key; });
    for_each_run(0, count, begins, [&](std::int64_t first, std::int64_t last) {
        if (last - first == 1) return;
        const auto begin = vertices.begin() + first, end = vertices.begin() + last;
        PlacedVertices of_cell(begin, end);
        const Eigen::AlignedBox3d cell = box_around(positions, of_cell);
        // Where a cell of the cell is no number any more, coordinates can still be compared.
        if (last - first > kMostInCell &&
            std::isnormal(std::ldexp(cell.sizes().maxCoeff(), -kDepthOfOrder))) {
            sort_along_curve(positions, cell, of_cell);
        } else {
            std::sort(of_cell.begin(), of_cell.end(), [&](const KeyValue& a, const KeyValue& b) {
                const Eigen::Vector3d &p = positions[a.value], &q = positions[b.value];
                return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
            });
        }
        std::copy(of_cell.begin(), of_cell.end(), begin);
        poll_progress();
    });
}

/// Returns the triangles that are selected and have three vertices, in new numbers.
RawVector<Triangle> renumbered(const TriangleMesh& mesh, const Selection& selection,
                               const Numbers& numbers) {
    const auto renamed = [&](std::int64_t i) {
        const Triangle& t = mesh.triangles[i];
        return Triangle{numbers[t[0]], numbers[t[1]], numbers[t[2]]};
    };
    return parallel_collect_if<Triangle, RawVector<Triangle>>(
        static_cast<std::int64_t>(mesh.triangles.size()),
        [&](std::int64_t i) {
            if (!selection.empty() && selection[i] == 0) return false;
            const Triangle t = renamed(i);
            return has_three_vertices(t) && !has_none(t);
        },
        renamed);
}

/// Sets the parts of a surface, and returns the new number of each vertex: part by part, and within
/// a part in the present order.
Numbers number_by_part(const RawVector<Triangle>& triangles, Surface& surface) {
    const auto count = static_cast<std::int32_t>(surface.mesh_vertices.size());
    DisjointSets sets(count);
    parallel_for_items(triangles, [&](const Triangle& t) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
    });
    Numbers part_of(surface.mesh_vertices.size());
    std::vector<std::int32_t> sizes;
    for (std::int32_t vertex = 0; vertex < count; ++vertex) {
        const std::int32_t first = sets.find(vertex);  // the least of the part
        if (first == vertex) sizes.push_back(0);
        part_of[vertex] =
            first == vertex ? static_cast<std::int32_t>(sizes.size()) - 1 : part_of[first];
        ++sizes[part_of[vertex]];
    }
    surface.part_count = static_cast<std::int32_t>(sizes.size());
    Numbers next, numbers(part_of.size());
    parallel_prefix_sum(
        surface.part_count, [&](std::int64_t part) { return sizes[part]; }, next);
    surface.parts.resize(part_of.size());
    for (std::int32_t vertex = 0; vertex < count; ++vertex) {
        numbers[vertex] = next[part_of[vertex]]++;
        surface.parts[numbers[vertex]] = part_of[vertex];
    }
    return numbers;
}

/// The other two vertices of a triangle, the smaller first, and whether it has them in this order.
std::tuple<std::int32_t, std::int32_t, bool> rest_of(const Triangle& t) {
    return {std::min(t[1], t[2]), std::max(t[1], t[2]), t[1] > t[2]};
}

bool are_copies(const Triangle& a, const Triangle& b) {
    return a[0] == b[0] && std::min(a[1], a[2]) == std::min(b[1], b[2]) &&
           std::max(a[1], a[2]) == std::max(b[1], b[2]);
}

/// Makes triangles begin at their least vertex, and sorts them. Copies are then next to each other.
void sort_triangles(RawVector<Triangle>& triangles) {
    const auto count = static_cast<std::int64_t>(triangles.size());
    parallel_for_rows(count, [&](std::int32_t i) {
        Triangle& t = triangles[i];
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    });
    const auto first = [](const Triangle& t) { return static_cast<std::uint32_t>(t[0]); };
    sort_by(triangles, first);
    const auto begins = runs_by(triangles, first);
    parallel_for_runs(count, begins, [&](std::int64_t begin, std::int64_t end) {
        for_each_run(begin, end, begins, [&](std::int64_t run, std::int64_t next) {
            std::sort(triangles.begin() + run, triangles.begin() + next,
                      [](const Triangle& a, const Triangle& b) { return rest_of(a) < rest_of(b); });
        });
    });
}

/// Replaces copies of triangles by one, in the direction of most of them. Returns the directions
/// that each triangle had; nothing if there were no copies.
std::vector<Directions> take_copies_out(RawVector<Triangle>& triangles) {
    const auto begins = [&](std::int64_t i) {
        return i == 0 || !are_copies(triangles[i], triangles[i - 1]);
    };
    const auto count = static_cast<std::int64_t>(triangles.size());
    const std::int64_t different = parallel_count(count, begins);
    if (different == count) return {};
    std::vector<Directions> directions;
    directions.reserve(static_cast<std::size_t>(different));
    for_each_run(0, count, begins, [&](std::int64_t first, std::int64_t last) {
        Triangle t = triangles[first];
        std::int64_t balance = 0;
        for (std::int64_t i = first; i < last; ++i) balance += triangles[i] == t ? 1 : -1;
        // Reading is ahead of writing, and a run is read before its triangle is written.
        const bool has_both = std::abs(balance) != last - first;
        if (balance < 0) std::swap(t[1], t[2]);
        triangles[directions.size()] = t;
        directions.push_back(balance == 0 ? Directions::Even
                             : has_both   ? Directions::Uneven
                                          : Directions::One);
    });
    triangles.resize(directions.size());
    return directions;
}

/// Returns the number of parts that have most of their area in both directions.
std::int64_t count_double_sided(const Surface& surface, const std::vector<Directions>& directions) {
    std::vector<double> balance(static_cast<std::size_t>(surface.part_count), 0);
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const Triangle& t = surface.stars.triangles[i];
        const auto [a, b, c] = corners_of(surface.positions, t);
        const double area = twice_vector_area(a, b, c).norm();
        balance[surface.parts[t[0]]] += directions[i] == Directions::One ? -area : area;
    }
    return std::count_if(balance.begin(), balance.end(), [](double sum) { return sum > 0; });
}

/// Sets the unit and the positions.
void set_positions(const TriangleMesh& mesh, Surface& surface) {
    const auto triangles = static_cast<std::int64_t>(surface.stars.triangles.size());
    const double perimeters =
        parallel_sum(triangles, 0.0, [&](std::int64_t begin, std::int64_t end) {
            double sum = 0;
            for (std::int64_t i = begin; i < end; ++i)
                sum += perimeter(corners_of(mesh.positions, surface.mesh_triangle(i)));
            return sum;
        });
    if (triangles > 0) surface.edge = perimeters / static_cast<double>(3 * triangles);
    surface.positions.resize(surface.mesh_vertices.size());
    for_each_number(surface.mesh_vertices, [&](std::int32_t vertex) {
        surface.positions[vertex] = surface.in_edges(mesh, vertex);
    });
}

/// Returns the surface of selected triangles, given the representative of each vertex of the mesh.
/// Nothing is held.
Surface welded_surface(const TriangleMesh& mesh, const Numbers& welded,
                       const Selection& selection) {
    Surface surface;
    PlacedVertices used = used_vertices(mesh, selection, welded);
    surface.box = box_around(mesh.positions, used);
    if (!used.empty()) {
        check_box(surface.box);
        sort_along_curve(mesh.positions, surface.box, used);
    }
    Numbers numbers(welded.size(), kNoVertex);
    surface.mesh_vertices.resize(used.size());
    for_each_number(surface.mesh_vertices, [&](std::int32_t i) {
        surface.mesh_vertices[i] = static_cast<std::int32_t>(used[i].value);
        numbers[surface.mesh_vertices[i]] = i;
    });
    PlacedVertices().swap(used);
    for_each_number(welded, [&](std::int32_t i) {
        if (welded[i] != i && welded[i] != kNoVertex) numbers[i] = numbers[welded[i]];
    });
    RawVector<Triangle> triangles = renumbered(mesh, selection, numbers);
    const auto with_three_vertices = static_cast<std::int64_t>(triangles.size());
    const Numbers by_part = number_by_part(triangles, surface);
    if (surface.part_count > 1) {
        Numbers mesh_vertices(by_part.size());
        for_each_number(
            by_part, [&](std::int32_t i) { mesh_vertices[by_part[i]] = surface.mesh_vertices[i]; });
        surface.mesh_vertices = std::move(mesh_vertices);
        for_each_number(numbers, [&](std::int32_t i) {
            if (numbers[i] >= 0) numbers[i] = by_part[numbers[i]];
        });
        parallel_for_rows(with_three_vertices, [&](std::int32_t i) {
            for (std::int32_t& vertex : triangles[i]) vertex = by_part[vertex];
        });
    }
    surface.vertices = std::move(numbers);
    sort_triangles(triangles);
    const std::vector<Directions> directions = take_copies_out(triangles);
    surface.stars =
        Stars(std::move(triangles), static_cast<std::int32_t>(surface.mesh_vertices.size()));
    set_positions(mesh, surface);
    if (!surface.is_oriented_alike()) orient_alike(surface, directions);
    surface.held.assign(surface.mesh_vertices.size(), 0);
    SurfaceCounts& counts = surface.counts;
    const auto all = static_cast<std::int64_t>(mesh.triangles.size());
    counts.unselected = std::count(selection.begin(), selection.end(), 0);
    counts.triangles = all - counts.unselected;
    counts.degenerate = counts.triangles - with_three_vertices;
    counts.copies = with_three_vertices - static_cast<std::int64_t>(surface.stars.triangles.size());
    counts.double_sided_parts = count_double_sided(surface, directions);
    return surface;
}

/// Returns the representative of each vertex of the mesh: itself, or one that is joined to it.
/// Vertices without one are in degenerate triangles alone.
Numbers representatives(const Surface& surface) {
    Numbers result(surface.vertices.size());
    for_each_number(result, [&](std::int32_t i) {
        const std::int32_t vertex = surface.vertices[i];
        result[i] = vertex < 0 ? kNoVertex : surface.mesh_vertices[vertex];
    });
    return result;
}

/// Counts the triangles of the surface that have no area.
void count_degenerate(const TriangleMesh& mesh, Surface& surface) {
    surface.counts.degenerate += parallel_count(
        static_cast<std::int64_t>(surface.stars.triangles.size()), [&](std::int64_t i) {
            return is_thin(corners_of(mesh.positions, surface.mesh_triangle(i)), kDegenerate);
        });
}

/// Returns the surface of selected triangles. Nothing is held.
Surface selected_surface(const Surface& whole, const TriangleMesh& mesh,
                         const Selection& selection) {
    Surface surface = welded_surface(mesh, representatives(whole), selection);
    surface.counts.cracks = whole.counts.cracks;
    return surface;
}

/// Returns, per vertex of a surface, the strength of its first vertex in the mesh.
std::vector<double> strengths_of(const Surface& surface, const std::vector<double>& of_mesh) {
    std::vector<double> strengths(surface.mesh_vertices.size());
    for (std::size_t i = of_mesh.size(); i-- > 0;) {
        if (surface.vertices[i] >= 0) strengths[surface.vertices[i]] = of_mesh[i];
    }
    return strengths;
}

/// Takes triangles whose three vertices have strength 0 out of a selection. Returns their number.
std::int64_t leave_zero_strength_out(const Surface& whole, const TriangleMesh& mesh,
                                     const std::vector<double>& of_mesh, Selection& selection) {
    const std::vector<double> strengths = strengths_of(whole, of_mesh);
    const auto is_zero = [&](std::int32_t vertex) {
        const std::int32_t of_surface = whole.vertices[vertex];
        return (of_surface >= 0 ? strengths[of_surface] : of_mesh[vertex]) == 0;
    };
    selection.resize(mesh.triangles.size(), 1);
    std::int64_t left_out = 0;
    for (std::size_t i = 0; i < selection.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        if (selection[i] == 0 || !std::all_of(t.begin(), t.end(), is_zero)) continue;
        selection[i] = 0;
        ++left_out;
    }
    if (std::count(selection.begin(), selection.end(), 0) ==
        static_cast<std::ptrdiff_t>(selection.size())) {
        throw InvalidMesh(
            "Nothing can move: all vertices of the faces to smooth have strength 0. Give some a "
            "larger one.");
    }
    return left_out;
}

}  // namespace

Positions Surface::in_mesh_units(const TriangleMesh& mesh) const {
    Positions result(mesh_vertices.size());
    for_each_number(mesh_vertices, [&](std::int32_t i) { result[i] = in_mesh_units(mesh, i); });
    return result;
}

bool Surface::has_held_vertices() const {
    return std::any_of(held.begin(), held.end(), [](std::uint8_t flag) { return flag != 0; });
}

std::int64_t Surface::genus() const {
    if (stars.has_rim() || stars.most_triangles_of_edge > 2) return 0;
    const std::int64_t characteristic = std::int64_t{stars.count()} - stars.edge_count() +
                                        static_cast<std::int64_t>(stars.triangles.size());
    return std::max<std::int64_t>(0, part_count - characteristic / 2);
}

Surface surface_of(const TriangleMesh& mesh) {
    Surface surface =
        welded_surface(mesh, weld_coincident_vertices(mesh, referenced_vertices(mesh)), {});
    const Cracks cracks = find_cracks(mesh, surface);
    if (!cracks.joined.empty()) {
        for (const auto& [a, b] : cracks.joined)
            surface.mesh_vertices[b] = surface.mesh_vertices[a];
        surface = welded_surface(mesh, representatives(surface), {});
    }
    surface.counts.cracks = cracks.report;
    return surface;
}

Surface surface_of_selection(const Surface& whole, const TriangleMesh& mesh,
                             const Selection& selection) {
    Surface surface = selected_surface(whole, mesh, selection);
    count_degenerate(mesh, surface);
    hold_seam(surface, mesh, selection);
    return surface;
}

Surface surface_of(const TriangleMesh& mesh, const Inputs& inputs, BoundaryCondition boundary) {
    Surface surface = surface_of(mesh);
    Selection selection = inputs.selection;
    std::int64_t zero_strength = 0;
    if (!inputs.strength.empty())
        zero_strength = leave_zero_strength_out(surface, mesh, inputs.strength, selection);
    if (std::find(selection.begin(), selection.end(), 0) == selection.end()) selection.clear();
    if (!selection.empty()) surface = selected_surface(surface, mesh, selection);
    surface.counts.zero_strength = zero_strength;
    surface.counts.unselected -= zero_strength;
    count_degenerate(mesh, surface);
    if (surface.counts.degenerate + surface.counts.copies == surface.counts.triangles)
        throw InvalidMesh("All faces to be smoothed are degenerate: none has an area.");
    if (!inputs.strength.empty()) surface.strengths = strengths_of(surface, inputs.strength);
    hold_vertices(surface, mesh, selection, boundary);
    return surface;
}

}  // namespace tracked_mcf
