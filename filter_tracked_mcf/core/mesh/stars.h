// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The triangles around each vertex of a surface, and the vertices that these join to it.
struct Stars {
    /// Takes triangles with three different vertices each, numbered from 0 to vertex_count - 1.
    Stars(RawVector<Triangle> surface_triangles, std::int32_t vertex_count);

    std::int32_t count() const { return static_cast<std::int32_t>(corner_begin.size()) - 1; }

    RawVector<Triangle> triangles;
    std::vector<std::uint32_t> corner_begin;  ///< per vertex, and the end
    RawVector<std::uint32_t> corners;  ///< 3 × triangle + corner, increasing for each vertex
    std::vector<std::uint32_t> neighbour_begin;  ///< per vertex, and the end
    RawVector<std::int32_t> neighbours;          ///< increasing for each vertex; without itself
    /// Per entry of `corners`: the places in `neighbours` of the triangle's next and previous
    /// corner.
    RawVector<std::array<std::uint32_t, 2>> places;
    /// Per 3 × triangle + corner: whether the side that begins there is on the rim, which is where
    /// no other triangle has it. Empty if the surface has no rim.
    std::vector<std::uint8_t> rim_sides;
    std::vector<std::uint8_t> on_rim;  ///< per vertex: whether it has such a side; or empty

private:
    void find_corners(std::int32_t vertex_count);
    void find_neighbours();
    void find_rim();
};

/// Calls visit(triangle, corner) for each triangle of a vertex's star, and the vertex's corner.
template <class Visit>
void for_each_corner(const Stars& stars, std::int32_t vertex, const Visit& visit) {
    for (std::uint32_t i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1]; ++i) {
        visit(stars.corners[i] / 3, stars.corners[i] % 3);
    }
}

/// Calls visit(neighbour) for each side on the rim that joins a vertex to a neighbour, if there is
/// a rim.
template <class Visit>
void for_each_rim_neighbour(const Stars& stars, std::int32_t vertex, const Visit& visit) {
    for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
        const std::uint32_t next = (corner + 1) % 3, previous = (corner + 2) % 3;
        const std::uint8_t* const on_rim = &stars.rim_sides[3 * std::size_t{triangle}];
        if (on_rim[corner] != 0) visit(stars.triangles[triangle][next]);
        if (on_rim[previous] != 0) visit(stars.triangles[triangle][previous]);
    });
}

/// Spreads values over neighbouring vertices: `steps` steps of a random walk that stays where it is
/// with a probability of at least a half. Sums stay the same. On average, a value goes the square
/// root of steps / 2 edges far.
void diffuse(const Stars& stars, int steps, std::vector<float>& values);

/// Returns the sum of body(row) over the rows, in an order that does not depend on the threads.
template <class Body>
double sum_over_rows(std::int32_t rows, const Body& body) {
    return parallel_sum(rows, 0.0, [&](std::int64_t begin, std::int64_t end) {
        double sum = 0;
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) sum += body(row);
        return sum;
    });
}

}  // namespace tracked_mcf
