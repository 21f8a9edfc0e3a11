// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// The largest distance of a pair that is joined, relative to the diagonal and to the shortest edge
/// at either vertex; and of a pair that is found, relative to that edge.
constexpr double kJoinedOfDiagonal = 1e-6, kJoinedOfEdge = 1e-4, kFoundOfEdge = 1e-2;
/// So many vertices are compared with one, at most: more in so small a place are no crack.
constexpr int kMostCompared = 64;

/// The width of the cells in which they are looked up, in distances: few cells are near a vertex.
constexpr double kCellWidth = 4;

constexpr std::int32_t kNone = -1;

/// The vertices on the rim, with numbers of their own.
struct Rims {
    Rims(const TriangleMesh& mesh, const Surface& surface)
        : stars(surface.stars), numbers(stars.on_rim.size(), kNone) {
        vertices = parallel_collect_if<std::int32_t>(
            static_cast<std::int64_t>(stars.on_rim.size()),
            [&](std::int64_t i) { return stars.on_rim[i] != 0; },
            [](std::int64_t i) { return static_cast<std::int32_t>(i); });
        positions.resize(vertices.size());
        shortest.resize(vertices.size());
        parallel_for_rows(count(), [&](std::int32_t i) {
            const std::int32_t vertex = vertices[i];
            numbers[vertex] = i;
            positions[i] = surface.in_mesh_units(mesh, vertex);
            double least = std::numeric_limits<double>::infinity();
            for (auto k = stars.neighbour_begin[vertex]; k < stars.neighbour_begin[vertex + 1]; ++k)
                least = std::min(
                    least,
                    (surface.in_mesh_units(mesh, stars.neighbours[k]) - positions[i]).norm());
            shortest[i] = least;
        });
    }

    std::int64_t count() const { return static_cast<std::int64_t>(vertices.size()); }
    /// Calls visit(neighbour) for each vertex that an edge of the rim joins to one.
    template <class Visit>
    void for_each_neighbour(std::int32_t number, const Visit& visit) const {
        for_each_rim_neighbour(stars, vertices[number],
                               [&](std::int32_t vertex) { visit(numbers[vertex]); });
    }
    double distance(std::int32_t i, std::int32_t j) const {
        return (positions[i] - positions[j]).norm();
    }

    const Stars& stars;
    std::vector<std::int32_t> numbers;   ///< per vertex of the surface, or kNone
    std::vector<std::int32_t> vertices;  ///< of the surface
    Positions positions;                 ///< mesh units
    std::vector<double> shortest;        ///< edge of each, on the rim or not
};

/// Returns the median length of the edges of the rim.
double median_edge(const Rims& rims) {
    auto lengths = parallel_collect<double>(
        rims.count(), [&](std::int64_t begin, std::int64_t end, std::vector<double>& out) {
            for (auto i = static_cast<std::int32_t>(begin); i < end; ++i)
                rims.for_each_neighbour(i, [&](std::int32_t j) {
                    if (i < j) out.push_back(rims.distance(i, j));
                });
        });
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/// Finds vertices of the rim within a distance, by their cells.
class Places {
public:
    Places(const Rims& rims, double distance)
        : rims_(rims), distance_(distance), items_(rims.vertices.size()) {
        parallel_for_rows(rims.count(), [&](std::int32_t i) {
            items_[i] = {cell_of(rims.positions[i]), static_cast<std::uint64_t>(i)};
        });
        sort_by_key(items_);
    }

    /// Returns the nearest vertex within the distance that is not next to `number` along the rim,
    /// or kNone, also if two are at the same distance.
    std::int32_t nearest(std::int32_t number) const {
        double least = distance_;
        std::int32_t found = kNone;
        int compared = 0;
        const auto has_neighbour = [&](std::int32_t other) {
            bool has = false;
            rims_.for_each_neighbour(number,
                                     [&](std::int32_t next) { has = has || next == other; });
            return has;
        };
        std::array<std::uint64_t, 8> cells = cells_near(rims_.positions[number]);
        std::sort(cells.begin(), cells.end());
        const auto end = std::unique(cells.begin(), cells.end());
        for (auto near = cells.begin(); near != end; ++near) {
            const std::uint64_t cell = *near;
            auto item =
                std::lower_bound(items_.begin(), items_.end(), cell,
                                 [](const KeyValue& a, std::uint64_t b) { return a.key < b; });
            for (; item != items_.end() && item->key == cell; ++item) {
                const auto other = static_cast<std::int32_t>(item->value);
                if (other == number || has_neighbour(other)) continue;
                if (++compared > kMostCompared) return kNone;
                const double distance = rims_.distance(number, other);
                if (distance > least) continue;
                found = distance < least ? other : kNone;
                least = distance;
            }
        }
        return found;
    }

private:
    /// Returns a cell's key. Two cells may have the same: then more vertices are compared.
    std::uint64_t cell_of(const Eigen::Vector3d& at) const {
        std::uint64_t key = 0;
        for (const double coordinate : at) {
            const auto cell =
                static_cast<std::int64_t>(std::floor(coordinate / (kCellWidth * distance_)));
            key = (key ^ static_cast<std::uint64_t>(cell)) * 0x9e3779b97f4a7c15U;
            key ^= key >> 32U;
        }
        return key;
    }
    /// Returns the cells at the corners of a box: all within the distance, some of them repeated.
    std::array<std::uint64_t, 8> cells_near(const Eigen::Vector3d& at) const {
        std::array<std::uint64_t, 8> cells{};
        for (int corner = 0; corner < 8; ++corner) {
            const Eigen::Array3i is_upper(corner & 1, corner / 2 & 1, corner / 4);
            const Eigen::Array3d side = 2 * is_upper.cast<double>() - 1;
            cells[corner] = cell_of(at + distance_ * side.matrix());
        }
        return cells;
    }

    const Rims& rims_;
    double distance_;
    RawVector<KeyValue> items_;  ///< key of the cell, vertex
};

/// Returns, per vertex of the rim, the other one of its pair or kNone. A triangle that has both is
/// narrow, and no crack.
std::vector<std::int32_t> pairs_of(const Rims& rims, double distance) {
    const Places places(rims, distance);
    std::vector<std::int32_t> nearest(rims.vertices.size()), pairs(rims.vertices.size(), kNone);
    parallel_for_rows(rims.count(), [&](std::int32_t i) { nearest[i] = places.nearest(i); });
    const auto are_mutual = [&](std::int32_t i, std::int32_t j) {
        return nearest[i] == j && nearest[j] == i;
    };
    parallel_for_rows(rims.count(), [&](std::int32_t i) {
        const std::int32_t j = nearest[i];
        if (j == kNone || !are_mutual(i, j) ||
            rims.stars.are_joined(rims.vertices[i], rims.vertices[j]))
            return;
        rims.for_each_neighbour(i, [&](std::int32_t next) {
            rims.for_each_neighbour(j, [&](std::int32_t other) {
                if (next == other || are_mutual(next, other)) pairs[i] = j;
            });
        });
    });
    return pairs;
}

}  // namespace

Cracks find_cracks(const TriangleMesh& mesh, const Surface& surface) {
    Cracks cracks;
    if (!surface.stars.has_rim()) return cracks;
    const Rims rims(mesh, surface);
    const double joined = kJoinedOfDiagonal * surface.box.diagonal().norm();
    const std::vector<std::int32_t> pairs =
        pairs_of(rims, std::max(joined, kFoundOfEdge * median_edge(rims)));
    for (std::int32_t i = 0; i < rims.count(); ++i) {
        const std::int32_t j = pairs[i];
        if (j < i) continue;  // kNone, too
        const double distance = rims.distance(i, j);
        const double shortest = std::min(rims.shortest[i], rims.shortest[j]);
        if (distance <= std::min(joined, kJoinedOfEdge * shortest)) {
            cracks.joined.push_back({rims.vertices[i], rims.vertices[j]});
        } else if (distance <= kFoundOfEdge * shortest) {
            ++cracks.report.open_pairs;
            cracks.report.open_width = std::max(cracks.report.open_width, distance);
        }
    }
    cracks.report.joined_vertices = static_cast<std::int64_t>(cracks.joined.size());
    return cracks;
}

}  // namespace tracked_mcf
