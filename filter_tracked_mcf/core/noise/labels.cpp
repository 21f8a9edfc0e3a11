// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/labels.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// A flat side is so many cells wide in all directions, and beside it there is at most this share
/// of its area.
constexpr int kInsideOfFlat = 2;
constexpr double kMostBesideFlat = 0.02;

/// A cell may be up to so many cells of the grid wide. Then this share of the area along each side
/// is at its multiples, in so many planes at least.
constexpr std::int64_t kMostSubdivision = 8;
constexpr double kAtMultiples = 0.95;
constexpr std::size_t kPlanesAtMultiples = 6;

/// The triangles at one plane.
struct SidePlane {
    double area = 0;
    bool is_wide = false;  ///< whether a triangle is far from the border of the plane
};

/// Per side, the planes at right angles to it. They are numbered by twice their coordinate.
using SidePlanes = std::array<std::map<std::int64_t, SidePlane>, 3>;

/// Two planes at the distance of a cell have numbers that differ by this.
constexpr std::int64_t kNextPlane = 2;

std::int64_t plane_of(const std::array<Eigen::Vector3d, 3>& corners, std::size_t side) {
    const auto axis = static_cast<Eigen::Index>(side);
    return std::lround(2 * (corners[0] + corners[1] + corners[2])[axis] / 3);
}

/// Returns the side that each triangle is at right angles to, or 3.
std::vector<std::uint8_t> sides_of(const NoisySurface& surface) {
    std::vector<std::uint8_t> sides(surface.stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(sides.size()), [&](std::int32_t i) {
        const Triangle& t = surface.stars.triangles[i];
        sides[i] = static_cast<std::uint8_t>(side_of(corners_of(surface.positions, t)));
    });
    return sides;
}

/// Marks the vertices whose stars are not at right angles to one side.
std::vector<std::uint8_t> uneven_vertices(const Stars& stars,
                                          const std::vector<std::uint8_t>& sides) {
    std::vector<std::uint8_t> uneven(static_cast<std::size_t>(stars.count()));
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        unsigned seen = 0;
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            seen |= 1U << sides[triangle];
        });
        uneven[vertex] = seen == 1 || seen == 2 || seen == 4 ? 0 : 1;
    });
    return uneven;
}

/// Marks the vertices that have no marked one within so many sides.
std::vector<std::uint8_t> far_from(const std::vector<std::uint8_t>& marked, const Stars& stars,
                                   int rings) {
    std::vector<std::uint8_t> far(marked.size());
    std::transform(marked.begin(), marked.end(), far.begin(),
                   [](std::uint8_t mark) { return mark == 0 ? 1 : 0; });
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<std::uint8_t> before = far;
        parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
            const std::int32_t* const neighbours = stars.neighbours.data();
            if (!std::all_of(neighbours + stars.neighbour_begin[vertex],
                             neighbours + stars.neighbour_begin[vertex + 1],
                             [&](std::int32_t other) { return before[other] != 0; }))
                far[vertex] = 0;
        });
    }
    return far;
}

SidePlanes planes_of(const Labels& labels, const std::vector<std::uint8_t>& sides) {
    const Stars& stars = labels.surface.stars;
    const std::vector<std::uint8_t> inner =
        far_from(labels.uneven, stars, static_cast<int>(kInsideOfFlat * labels.subdivision));
    SidePlanes planes;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (sides[i] == 3) continue;
        const Triangle& t = stars.triangles[i];
        const auto corners = corners_of(labels.surface.positions, t);
        SidePlane& plane = planes[sides[i]][plane_of(corners, sides[i])];
        plane.area += twice_vector_area(corners[0], corners[1], corners[2]).norm() / 2;
        plane.is_wide |= inner[t[0]] + inner[t[1]] + inner[t[2]] == 3;
    }
    return planes;
}

/// The planes along a side that are at multiples of so many cells from each other, and one of them.
struct Multiples {
    std::int64_t cells = 1, plane = 0;
};

/// Returns the widest multiples that nearly all of the area is at.
Multiples multiples_of(const std::map<std::int64_t, SidePlane>& planes) {
    if (planes.size() < kPlanesAtMultiples) return {};
    const double all =
        std::accumulate(planes.begin(), planes.end(), 0.0,
                        [](double sum, const auto& plane) { return sum + plane.second.area; });
    for (std::int64_t cells = kMostSubdivision; cells > 1; --cells) {
        std::map<std::int64_t, double> areas;
        const std::int64_t period = kNextPlane * cells;
        for (const auto& [number, plane] : planes)
            areas[(number % period + period) % period] += plane.area;
        const auto most =
            std::max_element(areas.begin(), areas.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        if (most->second >= kAtMultiples * all) return {cells, most->first};
    }
    return {};
}

/// Makes the cells as large as stairs are along all sides.
void enlarge_cells(const SidePlanes& planes, Labels& labels) {
    std::array<Multiples, 3> multiples;
    std::transform(planes.begin(), planes.end(), multiples.begin(), multiples_of);
    const std::int64_t cells =
        std::min({multiples[0].cells, multiples[1].cells, multiples[2].cells});
    if (cells == 1) return;
    Eigen::Vector3d corner;  // in cells of the grid
    for (std::size_t side = 0; side < 3; ++side)
        corner[static_cast<Eigen::Index>(side)] = static_cast<double>(multiples[side].plane) / 2;
    labels.lattice.origin += labels.lattice.cell * corner;
    labels.lattice.cell *= static_cast<double>(cells);
    labels.subdivision = static_cast<double>(cells);
    for (Eigen::Vector3d& position : labels.surface.positions)
        position = (position - corner) / static_cast<double>(cells);
}

std::array<bool, 3> sides_with_stairs(const SidePlanes& planes) {
    std::array<bool, 3> stairs = {};
    std::transform(planes.begin(), planes.end(), stairs.begin(), [](const auto& along) {
        const auto pairs = std::count_if(along.begin(), along.end(), [&](const auto& plane) {
            return along.count(plane.first + kNextPlane) != 0;
        });
        return pairs >= 2;
    });
    return stairs;
}

/// Returns whether a plane is a flat side of the shape.
bool is_flat_side(const std::map<std::int64_t, SidePlane>& planes, std::int64_t number) {
    const auto area = [&](std::int64_t other) {
        const auto found = planes.find(other);
        return found == planes.end() ? 0 : found->second.area;
    };
    return planes.at(number).is_wide &&
           area(number - kNextPlane) + area(number + kNextPlane) <= kMostBesideFlat * area(number);
}

void find_flat_sides(const SidePlanes& planes, const std::vector<std::uint8_t>& sides,
                     Labels& labels) {
    labels.flat_sides.assign(labels.vertices.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (sides[i] == 3) continue;
        const Triangle& t = labels.surface.stars.triangles[i];
        const std::int64_t number = plane_of(corners_of(labels.surface.positions, t), sides[i]);
        if (!is_flat_side(planes[sides[i]], number)) continue;
        for (const std::int32_t vertex : t)
            labels.flat_sides[vertex] |= static_cast<std::uint8_t>(1U << sides[i]);
    }
}

/// Returns the labels that parts on a lattice are, or none.
std::optional<Labels> labels_on(const NoisySurface& surface, const std::vector<PartRange>& parts,
                                const Lattice& lattice) {
    Labels labels;
    static_cast<SurfaceParts&>(labels) = parts_from(surface, parts);
    labels.lattice = lattice;
    const Eigen::Matrix3d inverse = lattice.cell.inverse();
    for (Eigen::Vector3d& position : labels.surface.positions)
        position = inverse * (position - lattice.origin);
    const std::vector<std::uint8_t> sides = sides_of(labels.surface);
    labels.uneven = uneven_vertices(labels.surface.stars, sides);
    SidePlanes planes = planes_of(labels, sides);
    enlarge_cells(planes, labels);
    if (labels.subdivision > 1) planes = planes_of(labels, sides);
    labels.has_stairs = sides_with_stairs(planes);
    const std::array<bool, 3>& stairs = labels.has_stairs;
    if (!lattice.is_marching && std::count(stairs.begin(), stairs.end(), true) < 2) return {};
    find_flat_sides(planes, sides, labels);
    return labels;
}

}  // namespace

double Labels::height() const {
    const bool is_any = has_stairs == std::array<bool, 3>{};
    double height = 0;
    for (std::size_t side = 0; side < 3; ++side) {
        const auto axis = static_cast<Eigen::Index>(side);
        if (is_any || has_stairs[side]) height = std::max(height, lattice.cell.col(axis).norm());
    }
    return height;
}

std::vector<Labels> labels_of(const NoisySurface& surface, std::vector<PartRange> parts) {
    std::stable_sort(parts.begin(), parts.end(), [](const PartRange& a, const PartRange& b) {
        return a.vertex_count() > b.vertex_count();
    });
    std::vector<Labels> all;
    for (auto part = parts.begin(); part != parts.end();) {
        const std::optional<Lattice> lattice = lattice_of(surface, *part);
        if (!lattice) {
            ++part;
            continue;
        }
        const auto others = std::stable_partition(part, parts.end(), [&](const PartRange& other) {
            return is_border(surface, other, *lattice);
        });
        std::sort(part, others, [](const PartRange& a, const PartRange& b) {
            return a.first_vertex < b.first_vertex;
        });
        if (auto labels = labels_on(surface, {part, others}, *lattice))
            all.push_back(*std::move(labels));
        part = others;
    }
    return all;
}

}  // namespace tracked_mcf
