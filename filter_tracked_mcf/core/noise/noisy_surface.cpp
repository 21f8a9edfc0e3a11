// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// The least strength that still moves a vertex, so that fidelities are finite.
constexpr double kLeastStrength = 1e-3;

/// A side of a triangle.
struct Side {
    std::int32_t triangle;
    bool forwards;  ///< from the edge's smaller vertex to the larger one
};

/// Lists the sides of each edge.
struct SidesOfEdges {
    explicit SidesOfEdges(const MeshTopology& topology)
        : begin(static_cast<std::size_t>(topology.edge_count) + 1, 0) {
        const auto for_each_side = [&](const auto& visit) {
            for (std::int32_t t = 0; t < static_cast<std::int32_t>(topology.edges.size()); ++t) {
                for (int side = 0; side < 3; ++side) {
                    const std::int32_t edge = topology.edges[t][side];
                    if (edge == MeshTopology::kNoEdge) continue;
                    const Triangle& corners = topology.triangles[t];
                    visit(edge, Side{t, corners[side] < corners[(side + 1) % 3]});
                }
            }
        };
        for_each_side([&](std::int32_t edge, Side /*side*/) { ++begin[edge + 1]; });
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        sides.resize(begin.back());
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for_each_side([&](std::int32_t edge, Side side) { sides[next[edge]++] = side; });
    }

    std::vector<std::uint32_t> begin;  ///< per edge, and the end
    RawVector<Side> sides;
};

/// Returns the triangles, those of each component oriented as most of its area is. A surface with
/// one side gets a seam.
RawVector<Triangle> oriented_triangles(const MeshTopology& topology,
                                       const std::vector<Eigen::Vector3d>& positions) {
    RawVector<Triangle> triangles = topology.triangles;
    if (topology.is_oriented_consistently()) return triangles;
    const SidesOfEdges edges(topology);
    constexpr std::uint8_t unknown = 2;
    std::vector<std::uint8_t> flipped(topology.triangles.size(), unknown);
    std::vector<std::int32_t> component;
    const auto add_neighbours = [&](std::int32_t triangle) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge == MeshTopology::kNoEdge) continue;
            const Side* const sides = edges.sides.data() + edges.begin[edge];
            // Where more than two triangles meet, none continues another.
            if (edges.begin[edge + 1] - edges.begin[edge] != 2) continue;
            const Side& other = sides[sides[0].triangle == triangle ? 1 : 0];
            if (flipped[other.triangle] != unknown) continue;
            const bool alike = sides[0].forwards != sides[1].forwards;
            const std::uint8_t here = flipped[triangle];
            flipped[other.triangle] = alike ? here : static_cast<std::uint8_t>(1 - here);
            component.push_back(other.triangle);
        }
    };
    for (std::size_t first = 0; first < flipped.size(); ++first) {
        if (flipped[first] != unknown) continue;
        flipped[first] = 0;
        component.assign(1, static_cast<std::int32_t>(first));
        std::array<double, 2> areas = {0, 0};  // as they are, flipped
        std::size_t visited = 0;
        while (visited < component.size()) {
            const std::int32_t t = component[visited++];
            add_neighbours(t);
            const auto [a, b, c] = corners_of(positions, topology.triangles[t]);
            areas[flipped[t]] += twice_vector_area(a, b, c).norm();
            poll_progress();
        }
        const std::uint8_t least = areas[1] > areas[0] ? 0 : 1;
        for (const std::int32_t t : component) {
            if (flipped[t] == least) std::swap(triangles[t][1], triangles[t][2]);
        }
    }
    return triangles;
}

/// Returns new numbers, from 0, for the vertices that have a mark, and -1 for the others.
std::vector<std::int32_t> numbers_of(const std::vector<std::uint8_t>& marked) {
    std::vector<std::int32_t> numbers(marked.size(), -1);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < marked.size(); ++i) {
        if (marked[i] != 0) numbers[i] = count++;
    }
    return numbers;
}

/// Returns the triangles whose vertices all have a number, with these numbers.
RawVector<Triangle> renumbered(const RawVector<Triangle>& triangles,
                               const std::vector<std::int32_t>& numbers) {
    RawVector<Triangle> result;
    result.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        const Triangle renamed = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
        if (std::min({renamed[0], renamed[1], renamed[2]}) >= 0 && has_three_vertices(t)) {
            result.push_back(renamed);
        }
    }
    return result;
}

/// A vertex with strength r keeps the waves that others keep of r times their length.
float fidelity_of(double strength) {
    const double square = strength * strength;
    return static_cast<float>(1 / (square * square));
}

/// Binary digits that a mean keeps, and its digits after the point in edges: the order of what is
/// added changes only later ones.
constexpr int kDigits = 40, kDigitsOfEdges = 30;

/// Returns the nearest multiple of 2^exponent.
double rounded(double number, int exponent) {
    return std::ldexp(std::nearbyint(std::ldexp(number, -exponent)), exponent);
}

}  // namespace

SurfaceOfMesh surface_of(const Domain& domain) {
    const TriangleMesh& mesh = domain.mesh();
    const RawVector<Triangle> triangles = oriented_triangles(domain.topology(), mesh.positions);
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (!has_three_vertices(t)) continue;
        for (const std::int32_t vertex : t) used[vertex] = 1;
    }
    SurfaceOfMesh result{{{{}, 0}, {}, {}}, numbers_of(used), 0};
    const double mean = mean_edge_length(domain.surface());
    result.edge = rounded(mean, std::ilogb(mean) - kDigits);
    NoisySurface& surface = result.surface;
    Eigen::AlignedBox3d box;  // its middle keeps coordinates small where a mesh is far from 0
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] != 0) box.extend(mesh.positions[i]);
    }
    const Eigen::Vector3d origin = box.center();
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] == 0) continue;
        const auto vertex = static_cast<std::int32_t>(i);
        const bool fixed = domain.constrained_vertices()[i] != 0;
        const double strength = std::max(domain.strength(vertex), kLeastStrength);
        surface.fidelity.push_back(fixed ? 0 : fidelity_of(strength));
        surface.positions.emplace_back((mesh.positions[i] - origin) / result.edge);
    }
    const auto count = static_cast<std::int32_t>(surface.positions.size());
    surface.stars = Stars(renumbered(triangles, result.vertices), count);
    for (std::size_t i = 0; i < used.size(); ++i) {
        result.vertices[i] = result.vertices[domain.topology().welded[i]];
    }
    return result;
}

Eigen::AlignedBox3d confinement(const Positions& positions) {
    constexpr double margin = 0.1;  // in diagonals
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : positions) box.extend(position);
    const Eigen::Vector3d added = Eigen::Vector3d::Constant(margin * box.diagonal().norm());
    return {box.min() - added, box.max() + added};
}

namespace {

/// A vertex, its squared distance from the mean of all, and its coordinates.
struct Ranked {
    double square, x, y, z;
    std::int32_t vertex;
};

/// Compares coordinates, too: many vertices of a symmetric surface are at the same distance.
bool operator<(const Ranked& a, const Ranked& b) {
    return std::tie(a.square, a.x, a.y, a.z) < std::tie(b.square, b.x, b.y, b.z);
}

std::vector<Ranked> ranked(const Positions& positions) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& position : positions) mean += position;
    mean /= static_cast<double>(positions.size());
    for (double& coordinate : mean) coordinate = rounded(coordinate, -kDigitsOfEdges);
    std::vector<Ranked> vertices(positions.size());
    parallel_for_rows(static_cast<std::int64_t>(vertices.size()), [&](std::int32_t i) {
        const Eigen::Vector3d& p = positions[i];
        vertices[i] = {(p - mean).squaredNorm(), p.x(), p.y(), p.z(), i};
    });
    return vertices;
}

/// Marks the vertices nearest to `seed`, counted in sides: as many whole rings as have
/// `count` vertices.
void mark_patch(const Stars& stars, std::int32_t seed, std::size_t count,
                std::vector<std::uint8_t>& marked) {
    std::vector<std::int32_t> patch(1, seed);
    marked[seed] = 1;
    std::size_t ring = 0;
    while (ring < patch.size() && patch.size() < count) {
        for (const std::size_t end = patch.size(); ring < end; ++ring) {
            const std::int32_t vertex = patch[ring];
            for (std::uint32_t k = stars.neighbour_begin[vertex];
                 k < stars.neighbour_begin[vertex + 1]; ++k) {
                const std::int32_t neighbour = stars.neighbours[k];
                if (marked[neighbour] != 0) continue;
                marked[neighbour] = 1;
                patch.push_back(neighbour);
            }
        }
    }
}

/// Returns a random sign for each number (splitmix64).
float sign_of(std::size_t number) {
    std::uint64_t bits = (std::uint64_t{number} + 1) * 0x9e3779b97f4a7c15U;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return (bits >> 63U) != 0 ? 1.0F : -1.0F;
}

}  // namespace

std::vector<std::int32_t> in_rank(const Positions& positions) {
    std::vector<Ranked> vertices = ranked(positions);
    std::sort(vertices.begin(), vertices.end());
    std::vector<std::int32_t> order(vertices.size());
    std::transform(vertices.begin(), vertices.end(), order.begin(),
                   [](const Ranked& ranked) { return ranked.vertex; });
    return order;
}

std::vector<float> random_signs(const Positions& positions) {
    const std::vector<std::int32_t> order = in_rank(positions);
    std::vector<float> signs(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) signs[order[rank]] = sign_of(rank);
    return signs;
}

Sample sample_of(const NoisySurface& surface, std::int32_t vertex_count,
                 const std::vector<float>& fidelities, std::int32_t patch) {
    const Stars& stars = surface.stars;
    const std::int32_t all = stars.count();
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(all), 1);
    if (all > 2 * vertex_count) {
        std::fill(marked.begin(), marked.end(), std::uint8_t{0});
        std::vector<Ranked> vertices = ranked(surface.positions);
        const std::int32_t patches = vertex_count / patch;
        auto begin = vertices.begin();
        for (std::int32_t i = 0; i < patches; ++i) {
            const auto seed = vertices.begin() + (2 * i + 1) * std::int64_t{all} / (2 * patches);
            std::nth_element(begin, seed, vertices.end());
            begin = seed;
            mark_patch(stars, seed->vertex, static_cast<std::size_t>(patch), marked);
        }
    }
    // Only whole triangles belong to the sample, and only their vertices.
    std::vector<std::uint8_t> used(marked.size(), 0);
    for (const Triangle& t : stars.triangles) {
        if (marked[t[0]] + marked[t[1]] + marked[t[2]] < 3) continue;
        for (const std::int32_t vertex : t) used[vertex] = 1;
    }
    const std::vector<std::int32_t> numbers = numbers_of(used);
    Sample sample{{{{}, 0}, {}, {}}, {}, {}};
    std::vector<std::uint32_t> star_sizes;
    for (std::int32_t i = 0; i < all; ++i) {
        if (used[i] == 0) continue;
        sample.surface.positions.push_back(surface.positions[i]);
        const float fidelity = fidelities.empty() ? 1 : fidelities[i];
        sample.surface.fidelity.push_back(surface.is_fixed(i) ? 0 : fidelity);
        star_sizes.push_back(stars.corner_begin[i + 1] - stars.corner_begin[i]);
    }
    const auto count = static_cast<std::int32_t>(star_sizes.size());
    sample.surface.stars = Stars(renumbered(stars.triangles, numbers), count);
    const std::vector<std::uint32_t>& begin = sample.surface.stars.corner_begin;
    const auto is_whole = [&](std::int32_t i) { return begin[i + 1] - begin[i] == star_sizes[i]; };
    for (std::int32_t i = 0; i < count; ++i) {
        const auto* const neighbours = sample.surface.stars.neighbours.data();
        const auto* const places = &sample.surface.stars.neighbour_begin[i];
        const bool is_inside =
            is_whole(i) && std::all_of(neighbours + places[0], neighbours + places[1], is_whole);
        sample.counts.push_back(is_inside && !sample.surface.is_fixed(i) ? 1 : 0);
    }
    sample.signs = random_signs(sample.surface.positions);
    return sample;
}

}  // namespace tracked_mcf
