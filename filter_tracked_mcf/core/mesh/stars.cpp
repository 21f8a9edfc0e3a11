// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/stars.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tracked_mcf {

Stars::Stars(RawVector<Triangle> surface_triangles, std::int32_t vertex_count)
    : triangles(std::move(surface_triangles)) {
    find_corners(vertex_count);
    find_neighbours();
    find_rim();
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

void Stars::find_neighbours() {
    using Row = std::vector<std::int32_t>;
    const auto for_each_row = [&](const auto& body) {
        parallel_for_chunks_with(
            count(), [] { return Row(); },
            [&](Row& row, std::int64_t begin, std::int64_t end) {
                for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                    row.clear();
                    for_each_corner(*this, vertex, [&](std::uint32_t t, std::uint32_t corner) {
                        row.push_back(triangles[t][(corner + 1) % 3]);
                        row.push_back(triangles[t][(corner + 2) % 3]);
                    });
                    std::sort(row.begin(), row.end());
                    row.erase(std::unique(row.begin(), row.end()), row.end());
                    body(vertex, row);
                }
            });
    };
    std::vector<std::uint32_t> sizes(static_cast<std::size_t>(count()));
    for_each_row([&](std::int32_t vertex, const Row& row) {
        sizes[vertex] = static_cast<std::uint32_t>(row.size());
    });
    parallel_prefix_sum(
        count(), [&](std::int64_t vertex) { return sizes[vertex]; }, neighbour_begin);
    neighbours.resize(neighbour_begin.back());
    places.resize(corners.size());
    for_each_row([&](std::int32_t vertex, const Row& row) {
        const std::uint32_t first = neighbour_begin[vertex];
        std::copy(row.begin(), row.end(), neighbours.begin() + first);
        for (std::uint32_t i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
            const Triangle& t = triangles[corners[i] / 3];
            for (std::uint32_t k = 0; k < 2; ++k) {
                const auto place =
                    std::lower_bound(row.begin(), row.end(), t[(corners[i] % 3 + k + 1) % 3]);
                places[i][k] = first + static_cast<std::uint32_t>(place - row.begin());
            }
        }
    });
}

void Stars::find_rim() {
    RawVector<std::uint8_t> triangles_of(neighbours.size());  // per edge: their number, at most 2
    parallel_for_rows(count(), [&](std::int32_t vertex) {
        for (auto i = neighbour_begin[vertex]; i < neighbour_begin[vertex + 1]; ++i) {
            triangles_of[i] = 0;
        }
        for (auto i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
            for (const std::uint32_t place : places[i]) {
                if (triangles_of[place] < 2) ++triangles_of[place];
            }
        }
    });
    const auto is_single = [&](std::int64_t i) { return triangles_of[i] == 1; };
    if (parallel_count(static_cast<std::int64_t>(triangles_of.size()), is_single) == 0) return;
    rim_sides.resize(corners.size());
    on_rim.resize(static_cast<std::size_t>(count()));
    parallel_for_rows(count(), [&](std::int32_t vertex) {
        for (auto i = corner_begin[vertex]; i < corner_begin[vertex + 1]; ++i) {
            const bool begins = is_single(places[i][0]);
            rim_sides[corners[i]] = begins ? 1 : 0;
            if (begins || is_single(places[i][1])) on_rim[vertex] = 1;
        }
    });
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
