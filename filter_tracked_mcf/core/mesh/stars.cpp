// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/stars.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

Stars::Stars(RawVector<Triangle> surface_triangles, std::int32_t vertex_count)
    : triangles(std::move(surface_triangles)) {
    find_corners(vertex_count);
    find_neighbours();
    examine_edges();
}

// A counting sort.
void Stars::find_corners(std::int32_t vertex_count) {
    corner_begin.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (const Triangle& t : triangles) {
        for (const std::int32_t vertex : t) ++corner_begin[vertex + 1];
    }
    std::partial_sum(corner_begin.begin(), corner_begin.end(), corner_begin.begin());
    corners.resize(3 * triangles.size());
    std::vector<std::uint32_t> next(corner_begin.begin(), corner_begin.end() - 1);
    for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
        corners[next[triangles[corner / 3][corner % 3]]++] = corner;
    }
}

namespace {

/// Sets `row` to the neighbours of a vertex in its star, in increasing order.
void list_neighbours(const Stars& stars, std::int32_t vertex, std::vector<std::int32_t>& row) {
    const auto sort = [&] {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
    };
    row.clear();
    for_each_corner(stars, vertex, [&](std::uint32_t t, std::uint32_t corner) {
        row.push_back(stars.triangles[t][(corner + 1) % 3]);
    });
    sort();
    // Away from rims, each neighbour is the next corner of a triangle.
    const auto next_corners = static_cast<std::ptrdiff_t>(row.size());
    for_each_corner(stars, vertex, [&](std::uint32_t t, std::uint32_t corner) {
        const std::int32_t previous = stars.triangles[t][(corner + 2) % 3];
        if (!std::binary_search(row.begin(), row.begin() + next_corners, previous))
            row.push_back(previous);
    });
    if (static_cast<std::ptrdiff_t>(row.size()) > next_corners) sort();
}

}  // namespace

// Threads list the rows of a chunk, which are then put behind each other.
void Stars::find_neighbours() {
    std::vector<std::uint32_t> sizes(static_cast<std::size_t>(count()));
    places.resize(corners.size());  // within a row, at first
    neighbours = parallel_collect<std::int32_t, RawVector<std::int32_t>>(
        count(), [&](std::int64_t begin, std::int64_t end, std::vector<std::int32_t>& out) {
            std::vector<std::int32_t> row;
            for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                list_neighbours(*this, vertex, row);
                for (std::uint32_t i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
                    const Triangle& t = triangles[corners[i] / 3];
                    for (std::uint32_t k = 0; k < 2; ++k) {
                        const std::int32_t other = t[(corners[i] % 3 + k + 1) % 3];
                        const auto place = std::lower_bound(row.begin(), row.end(), other);
                        places[i][k] = static_cast<std::uint32_t>(place - row.begin());
                    }
                }
                sizes[vertex] = static_cast<std::uint32_t>(row.size());
                out.insert(out.end(), row.begin(), row.end());
            }
        });
    if (neighbours.size() > std::numeric_limits<std::uint32_t>::max())
        throw InvalidMesh("The mesh has more than 2147483647 edges; simplify it first.");
    parallel_prefix_sum(
        count(), [&](std::int64_t vertex) { return sizes[vertex]; }, neighbour_begin);
    parallel_for_rows(count(), [&](std::int32_t vertex) {
        for (std::uint32_t i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
            for (std::uint32_t& place : places[i]) place += neighbour_begin[vertex];
        }
    });
}

// All triangles of an edge are in the stars of both of its ends, so each vertex sees all of its
// edges.
void Stars::examine_edges() {
    struct Edge {
        std::int32_t outwards = 0, inwards = 0;  ///< triangles that pass along it, by direction
        std::int32_t triangles() const { return outwards + inwards; }
    };
    using Row = std::vector<Edge>;
    const auto for_each_row = [&](const auto& body) {
        parallel_for_chunks_with(
            count(), [] { return Row(); },
            [&](Row& row, std::int64_t begin, std::int64_t end) {
                for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                    const std::uint32_t first = neighbour_begin[vertex];
                    row.assign(neighbour_begin[vertex + 1] - first, {});
                    for (auto i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
                        ++row[places[i][0] - first].outwards;
                        ++row[places[i][1] - first].inwards;
                    }
                    body(vertex, row, begin / kChunkSize);
                }
            });
    };
    struct Extremes {
        std::int32_t imbalance = 0, most = 0;
        bool has_rim = false;
    };
    std::vector<Extremes> of_chunks(static_cast<std::size_t>(chunk_count(count())));
    for_each_row([&](std::int32_t /*vertex*/, const Row& row, std::int64_t chunk) {
        Extremes& extremes = of_chunks[chunk];
        for (const Edge& edge : row) {
            extremes.imbalance =
                std::max(extremes.imbalance, std::abs(edge.outwards - edge.inwards));
            extremes.most = std::max(extremes.most, edge.triangles());
            extremes.has_rim = extremes.has_rim || edge.triangles() == 1;
        }
    });
    bool has_rim = false;
    for (const Extremes& extremes : of_chunks) {
        imbalance = std::max(imbalance, extremes.imbalance);
        most_triangles_of_edge = std::max(most_triangles_of_edge, extremes.most);
        has_rim = has_rim || extremes.has_rim;
    }
    if (!has_rim) return;
    rim_sides.resize(corners.size());
    on_rim.resize(static_cast<std::size_t>(count()));
    for_each_row([&](std::int32_t vertex, const Row& row, std::int64_t /*chunk*/) {
        const auto is_single = [&](std::uint32_t place) {
            return row[place - neighbour_begin[vertex]].triangles() == 1;
        };
        for (auto i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
            const bool begins = is_single(places[i][0]);
            rim_sides[corners[i]] = begins ? 1 : 0;
            if (begins || is_single(places[i][1])) on_rim[vertex] = 1;
        }
    });
}

std::uint32_t Stars::entry(std::int32_t vertex, std::int32_t neighbour) const {
    const auto first = neighbours.begin() + neighbour_begin[vertex];
    const auto last = neighbours.begin() + neighbour_begin[vertex + 1];
    return static_cast<std::uint32_t>(std::lower_bound(first, last, neighbour) -
                                      neighbours.begin());
}

void diffuse(const Stars& stars, int steps, std::vector<float>& values) {
    const auto degree = [&](std::int32_t vertex) {
        return stars.neighbour_begin[vertex + 1] - stars.neighbour_begin[vertex];
    };
    std::vector<float> next(values.size());
    for (int step = 0; step < steps; ++step) {
        parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
            float sum = 0;
            for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
                 ++i) {
                const std::int32_t other = stars.neighbours[i];
                const auto most = static_cast<float>(std::max(degree(vertex), degree(other)));
                sum += (values[other] - values[vertex]) / (2 * most);
            }
            next[vertex] = values[vertex] + sum;
        });
        values.swap(next);
    }
}

}  // namespace tracked_mcf
