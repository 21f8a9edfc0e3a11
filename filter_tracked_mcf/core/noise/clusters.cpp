// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/clusters.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tracked_mcf {

namespace {

constexpr std::int32_t kNoCluster = -1;

/// Returns vertices, one after the other in an order that does not depend on their numbers, that
/// are more than `radius` sides from all before.
std::vector<std::int32_t> seeds_of(const NoisySurface& surface, int radius) {
    std::vector<std::int32_t> seeds;
    std::vector<std::uint8_t> is_taken(surface.positions.size(), 0);
    std::vector<std::int32_t> visited_by(surface.positions.size(), kNoCluster), near;
    for (const std::int32_t seed : in_rank(surface.positions)) {
        if (is_taken[seed] != 0) continue;
        seeds.push_back(seed);
        near.assign(1, seed);
        visited_by[seed] = seed;
        std::size_t begin = 0;
        for (int distance = 0; distance < radius; ++distance) {
            for (const std::size_t end = near.size(); begin < end; ++begin) {
                for_each_neighbour(surface.stars, near[begin], [&](std::int32_t neighbour) {
                    if (visited_by[neighbour] == seed) return;
                    visited_by[neighbour] = seed;
                    near.push_back(neighbour);
                });
            }
            poll_progress();
        }
        for (const std::int32_t vertex : near) is_taken[vertex] = 1;
    }
    return seeds;
}

/// Returns per vertex the nearest seed, counted in sides; of several, the first one.
std::vector<std::int32_t> nearest_seeds(const Stars& stars,
                                        const std::vector<std::int32_t>& seeds) {
    std::vector<std::int32_t> nearest(static_cast<std::size_t>(stars.count()), kNoCluster);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        nearest[seeds[i]] = static_cast<std::int32_t>(i);
    }
    std::vector<std::int32_t> front = seeds, next;
    while (!front.empty()) {
        next.clear();
        std::vector<std::pair<std::int32_t, std::int32_t>> reached;  // vertex, seed
        for (const std::int32_t vertex : front) {
            for_each_neighbour(stars, vertex, [&](std::int32_t neighbour) {
                if (nearest[neighbour] == kNoCluster)
                    reached.emplace_back(neighbour, nearest[vertex]);
            });
        }
        std::sort(reached.begin(), reached.end());
        for (const auto& [vertex, seed] : reached) {
            if (nearest[vertex] != kNoCluster) continue;
            nearest[vertex] = seed;
            next.push_back(vertex);
        }
        front.swap(next);
    }
    return nearest;
}

/// Returns the triangles between three clusters, each once.
RawVector<Triangle> triangles_between(const Stars& stars,
                                      const std::vector<std::int32_t>& cluster) {
    RawVector<Triangle> triangles;
    for (const Triangle& t : stars.triangles) {
        Triangle between = {cluster[t[0]], cluster[t[1]], cluster[t[2]]};
        if (!has_three_vertices(between)) continue;
        std::rotate(between.begin(), std::min_element(between.begin(), between.end()),
                    between.end());
        triangles.push_back(between);
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

}  // namespace

Clusters clusters_of(const Sample& sample, int radius) {
    const NoisySurface& fine = sample.surface;
    const std::vector<std::int32_t> seeds = seeds_of(fine, radius);
    const std::vector<std::int32_t> nearest = nearest_seeds(fine.stars, seeds);
    RawVector<Triangle> triangles = triangles_between(fine.stars, nearest);
    std::vector<std::uint8_t> used(seeds.size(), 0);
    for (const Triangle& t : triangles) {
        for (const std::int32_t cluster : t) used[cluster] = 1;
    }
    std::vector<std::int32_t> numbers(seeds.size(), kNoCluster);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] != 0) numbers[i] = count++;
    }
    for (Triangle& t : triangles) {
        for (std::int32_t& corner : t) corner = numbers[corner];
    }
    Clusters result;
    NoisySurface& surface = result.sample.surface;
    surface.positions.assign(static_cast<std::size_t>(count), Eigen::Vector3d::Zero());
    surface.fidelity.assign(surface.positions.size(), 0);
    result.sample.counts.assign(surface.positions.size(), 1);
    std::vector<double> members(surface.positions.size(), 0);
    for (std::int32_t vertex = 0; vertex < fine.stars.count(); ++vertex) {
        const std::int32_t cluster =
            nearest[vertex] == kNoCluster ? kNoCluster : numbers[nearest[vertex]];
        if (cluster == kNoCluster) continue;
        surface.positions[cluster] += fine.positions[vertex];
        members[cluster] += 1;
        // A cluster moves if one of its vertices does, and counts if all do.
        if (!fine.is_held(vertex)) surface.fidelity[cluster] = 1;
        if (sample.counts[vertex] == 0) result.sample.counts[cluster] = 0;
    }
    for (std::size_t i = 0; i < members.size(); ++i) surface.positions[i] /= members[i];
    double length = 0;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            length += (surface.positions[t[k]] - surface.positions[t[(k + 1) % 3]]).norm();
        }
    }
    if (length > 0) result.edge = length / (3 * static_cast<double>(triangles.size()));
    for (Eigen::Vector3d& position : surface.positions) position /= result.edge;
    surface.stars = Stars(std::move(triangles), count);
    result.sample.signs = random_signs(surface.positions);
    return result;
}

}  // namespace tracked_mcf
