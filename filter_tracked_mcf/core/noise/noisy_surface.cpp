// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tracked_mcf {

namespace {

/// The least strength that still moves a vertex, so that fidelities are finite.
constexpr double kLeastStrength = 1e-3;

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

/// Digits after the point, in edges, of a mean: the order of what is added changes only later ones.
constexpr int kDigitsOfEdges = 30;

/// Returns the nearest multiple of 2^exponent.
double rounded(double number, int exponent) {
    return std::ldexp(std::nearbyint(std::ldexp(number, -exponent)), exponent);
}

}  // namespace

std::vector<float> fidelities_of(const Surface& surface) {
    std::vector<float> fidelities(surface.held.size());
    for (std::size_t i = 0; i < fidelities.size(); ++i) {
        const double strength = surface.strengths.empty() ? 1 : surface.strengths[i];
        fidelities[i] = surface.held[i] != 0 ? 0 : fidelity_of(std::max(strength, kLeastStrength));
    }
    return fidelities;
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

/// Marks the vertices nearest to `seed`, counted in sides: as many whole rings as have `count`
/// vertices, but for those that are marked. Returns how many it marks.
std::size_t mark_region(const Stars& stars, std::int32_t seed, std::size_t count,
                        std::vector<std::uint8_t>& marked) {
    if (marked[seed] != 0) return 0;
    std::vector<std::int32_t> region(1, seed);
    marked[seed] = 1;
    std::size_t ring = 0;
    while (ring < region.size() && region.size() < count) {
        for (const std::size_t end = region.size(); ring < end; ++ring) {
            const std::int32_t vertex = region[ring];
            for (std::uint32_t k = stars.neighbour_begin[vertex];
                 k < stars.neighbour_begin[vertex + 1]; ++k) {
                const std::int32_t neighbour = stars.neighbours[k];
                if (marked[neighbour] != 0) continue;
                marked[neighbour] = 1;
                region.push_back(neighbour);
            }
        }
    }
    return region.size();
}

using RankedIterator = std::vector<Ranked>::iterator;

/// Puts there the vertices that sorting would put at `places`, which increase.
void select(RankedIterator begin, RankedIterator end, const RankedIterator* first,
            const RankedIterator* last) {
    if (first == last) return;
    const RankedIterator* const middle = first + (last - first) / 2;
    std::nth_element(begin, *middle, end);
    select(begin, *middle, first, middle);
    select(*middle + 1, end, middle + 1, last);
}

/// Marks regions of a surface that have about so many vertices together. Their seeds are at odd
/// multiples of a fraction of the ranks. If parts are too small for whole regions, there are twice
/// as many seeds each further time.
std::vector<std::uint8_t> marked_regions(const NoisySurface& surface, std::int32_t vertex_count,
                                         std::int32_t region) {
    std::vector<std::uint8_t> marked(surface.positions.size(), 0);
    std::vector<Ranked> vertices = ranked(surface.positions);
    const auto all = static_cast<std::int64_t>(vertices.size());
    const auto most = static_cast<std::size_t>(vertex_count);
    std::size_t count = 0;
    for (std::int64_t regions = vertex_count / region; regions <= all && 2 * count < most;
         regions *= 2) {
        std::vector<RankedIterator> seeds(static_cast<std::size_t>(regions));
        for (std::int64_t i = 0; i < regions; ++i)
            seeds[i] = vertices.begin() + (2 * i + 1) * all / (2 * regions);
        select(vertices.begin(), vertices.end(), seeds.data(), seeds.data() + seeds.size());
        for (std::size_t i = 0; i < seeds.size() && count < most; ++i) {
            count += mark_region(surface.stars, seeds[i]->vertex, static_cast<std::size_t>(region),
                                 marked);
        }
    }
    return marked;
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
                 const std::vector<float>& fidelities, std::int32_t region) {
    const Stars& stars = surface.stars;
    const std::int32_t all = stars.count();
    const std::vector<std::uint8_t> marked =
        all > 2 * vertex_count ? marked_regions(surface, vertex_count, region)
                               : std::vector<std::uint8_t>(surface.positions.size(), 1);
    // Only whole triangles belong to the sample, and only their vertices.
    std::vector<std::uint8_t> used(marked.size(), 0);
    for (const Triangle& t : stars.triangles) {
        if (marked[t[0]] + marked[t[1]] + marked[t[2]] < 3) continue;
        for (const std::int32_t vertex : t) used[vertex] = 1;
    }
    const std::vector<std::int32_t> numbers = numbers_of(used);
    Sample sample;
    std::vector<std::uint32_t> star_sizes;
    for (std::int32_t i = 0; i < all; ++i) {
        if (used[i] == 0) continue;
        sample.surface.positions.push_back(surface.positions[i]);
        const float fidelity = fidelities.empty() ? 1 : fidelities[i];
        sample.surface.fidelity.push_back(surface.is_held(i) ? 0 : fidelity);
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
        sample.counts.push_back(is_inside && !sample.surface.is_held(i) ? 1 : 0);
    }
    sample.signs = random_signs(sample.surface.positions);
    return sample;
}

}  // namespace tracked_mcf
