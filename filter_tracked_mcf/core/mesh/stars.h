// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// One position, or displacement, per vertex.
using Positions = std::vector<Eigen::Vector3d>;

/// Returns whether a triangle's vertices differ.
constexpr bool has_three_vertices(const Triangle& t) {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

/// The adjacency of a surface: the triangles around each vertex, and the vertices that these join
/// to it. Side i of a triangle goes from its corner i to its corner (i + 1) % 3. Any number of
/// triangles may share an edge.
struct Stars {
    /// A surface without vertices.
    Stars() = default;
    /// Takes triangles with three different vertices each, numbered from 0 to vertex_count - 1.
    /// Throws InvalidMesh if they have more than 2147483647 edges.
    Stars(RawVector<Triangle> surface_triangles, std::int32_t vertex_count);

    std::int32_t count() const { return static_cast<std::int32_t>(corner_begin.size()) - 1; }
    std::int64_t edge_count() const { return static_cast<std::int64_t>(neighbours.size() / 2); }
    bool has_rim() const { return !on_rim.empty(); }
    /// Returns the entry of `neighbours` at which a vertex has this neighbour; if it has not, that
    /// of the next larger one, or the end of the vertex's entries.
    std::uint32_t entry(std::int32_t vertex, std::int32_t neighbour) const;
    /// Returns whether an edge joins two vertices.
    bool are_joined(std::int32_t a, std::int32_t b) const {
        const std::uint32_t i = entry(a, b);
        return i < neighbour_begin[a + 1] && neighbours[i] == b;
    }

    RawVector<Triangle> triangles;
    std::vector<std::uint32_t> corner_begin = {0};  ///< per vertex, and the end
    RawVector<std::uint32_t> corners;  ///< 3 × triangle + corner, increasing for each vertex
    std::vector<std::uint32_t> neighbour_begin = {0};  ///< per vertex, and the end
    RawVector<std::int32_t> neighbours;  ///< increasing for each vertex; without itself
    /// Per entry of `corners`: the entries in `neighbours` of the triangle's next and previous
    /// corner.
    RawVector<std::array<std::uint32_t, 2>> places;
    /// Per 3 × triangle + corner: whether the side that begins there is on the rim, which is where
    /// no other triangle has it. Empty if the surface has no rim.
    std::vector<std::uint8_t> rim_sides;
    std::vector<std::uint8_t> on_rim;  ///< per vertex: whether it has such a side; or empty
    /// The largest difference, over all edges, between the numbers of triangles that pass along the
    /// edge in one and in the other direction. The surface bounds a volume where it is 0, and is
    /// oriented alike where it is at most 1.
    std::int32_t imbalance = 0;
    std::int32_t most_triangles_of_edge = 0;

private:
    void find_corners(std::int32_t vertex_count);
    void find_neighbours();
    void examine_edges();
};

/// Calls visit(triangle, corner) for each triangle of a vertex's star, and the vertex's corner.
template <class Visit>
void for_each_corner(const Stars& stars, std::int32_t vertex, const Visit& visit) {
    for (std::uint32_t i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1]; ++i) {
        visit(stars.corners[i] / 3, stars.corners[i] % 3);
    }
}

/// Calls visit(neighbour) for each vertex that a side joins to a vertex.
template <class Visit>
void for_each_neighbour(const Stars& stars, std::int32_t vertex, const Visit& visit) {
    for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i) {
        visit(stars.neighbours[i]);
    }
}

/// Calls visit(neighbour) for each side on the rim that joins a vertex to a neighbour. The surface
/// must have a rim.
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
double sum_over_rows(std::int64_t rows, const Body& body) {
    return parallel_sum(rows, 0.0, [&](std::int64_t begin, std::int64_t end) {
        double sum = 0;
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) sum += body(row);
        return sum;
    });
}

}  // namespace tracked_mcf
