// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/spikes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// A spike is as high as so many edges and mean distances of its neighbours from their middle, and
/// as so many robust deviations of the vertices within two sides. Noise of half an edge reaches 3
/// of these.
constexpr double kLeastSpike = 1.5, kLeastDeviations = 5, kDeviationOverMedian = 1.4826;

/// The vertices two sides away are near the plane of the neighbours, relative to the height: they
/// are not below the tip of a horn.
constexpr double kMostDepth = 0.25;

/// More of them than this share are a pattern.
constexpr double kMostSpikes = 0.04;

/// Where the neighbours of a vertex are.
struct Ring {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
    double radius = 0;  ///< mean distance of the neighbours from their middle

    double height(const Eigen::Vector3d& position) const { return (position - middle).dot(normal); }
};

/// Returns the ring around a vertex. Its normal does not depend on where the vertex is.
Ring ring_of(const NoisySurface& surface, std::int32_t vertex) {
    const Stars& stars = surface.stars;
    Ring ring;
    const auto begin = stars.neighbour_begin[vertex], end = stars.neighbour_begin[vertex + 1];
    const auto count = static_cast<double>(end - begin);
    for (auto i = begin; i < end; ++i) ring.middle += surface.positions[stars.neighbours[i]];
    ring.middle /= count;
    for (auto i = begin; i < end; ++i)
        ring.radius += (surface.positions[stars.neighbours[i]] - ring.middle).norm() / count;
    for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t) {
        const auto [a, b, c] = corners_of(surface.positions, stars.triangles[triangle]);
        ring.normal += twice_vector_area(a, b, c);
    });
    ring.normal.normalize();
    return ring;
}

/// Returns the vertices within two sides of a vertex: itself, its neighbours, and the others.
std::vector<std::int32_t> near(const Stars& stars, std::int32_t vertex) {
    std::vector<std::int32_t> found = {vertex};
    for (std::size_t begin = 0, side = 0; side < 2; ++side) {
        for (const std::size_t end = found.size(); begin < end; ++begin) {
            const std::int32_t from = found[begin];
            for (auto i = stars.neighbour_begin[from]; i < stars.neighbour_begin[from + 1]; ++i) {
                if (std::find(found.begin(), found.end(), stars.neighbours[i]) == found.end())
                    found.push_back(stars.neighbours[i]);
            }
        }
    }
    return found;
}

double median_number(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How a vertex stands over the vertices around it.
struct Stand {
    double usual = 0;  ///< median magnitude of their heights over their own rings
    double depth = 0;  ///< median height over the ring of those that are two sides away
};

Stand stand_of(const NoisySurface& surface, const Ring& ring, std::int32_t vertex) {
    const Stars& stars = surface.stars;
    const std::vector<std::int32_t> around = near(stars, vertex);
    const std::size_t farther =
        1 + stars.neighbour_begin[vertex + 1] - stars.neighbour_begin[vertex];
    std::vector<double> magnitudes, depths;
    for (std::size_t i = 1; i < around.size(); ++i) {
        const Ring of_other = ring_of(surface, around[i]);
        magnitudes.push_back(std::abs(of_other.height(surface.positions[around[i]])));
        if (i >= farther) depths.push_back(ring.height(surface.positions[around[i]]));
    }
    return {median_number(std::move(magnitudes)), median_number(std::move(depths))};
}

/// Returns whether a vertex is so far from the middle of its neighbours that it may be a spike.
bool may_be_spike(const NoisySurface& surface, std::int32_t vertex) {
    const Stars& stars = surface.stars;
    if (surface.is_held(vertex) || (stars.has_rim() && stars.on_rim[vertex] != 0)) return false;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const auto begin = stars.neighbour_begin[vertex], end = stars.neighbour_begin[vertex + 1];
    for (auto i = begin; i < end; ++i) sum += surface.positions[stars.neighbours[i]];
    const double count = end - begin;
    return (count * surface.positions[vertex] - sum).norm() > count * kLeastSpike;
}

}  // namespace

std::vector<Spike> spikes_of(const NoisySurface& surface) {
    const Stars& stars = surface.stars;
    std::vector<std::uint8_t> are_far(surface.positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        are_far[vertex] = may_be_spike(surface, vertex) ? 1 : 0;
    });
    std::vector<Spike> spikes;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (are_far[vertex] == 0) continue;
        const Ring ring = ring_of(surface, vertex);
        const double height = ring.height(surface.positions[vertex]);
        if (std::abs(height) <= kLeastSpike * std::max(1.0, ring.radius)) continue;
        const Stand stand = stand_of(surface, ring, vertex);
        if (std::abs(height) <= kLeastDeviations * kDeviationOverMedian * stand.usual ||
            std::abs(stand.depth) >= kMostDepth * std::abs(height))
            continue;
        // On a sphere, the vertices two sides away are three times as deep below the ring as it is
        // below its middle.
        spikes.push_back(
            {vertex, surface.positions[vertex] - (height + stand.depth / 3) * ring.normal});
    }
    const bool are_rare = static_cast<double>(spikes.size()) <
                          kMostSpikes * static_cast<double>(surface.positions.size());
    return are_rare ? spikes : std::vector<Spike>();
}

}  // namespace tracked_mcf
