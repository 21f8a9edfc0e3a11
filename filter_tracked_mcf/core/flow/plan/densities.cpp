// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/densities.h"

#include <algorithm>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// Returns, for each vertex, the mean edge length of its triangles. Coincident vertices are one;
/// those that no triangle uses have 0.
std::vector<double> local_edge_lengths(const Domain& domain) {
    const std::vector<Eigen::Vector3d>& positions = domain.mesh().positions;
    std::vector<double> lengths(positions.size());
    std::vector<std::int32_t> triangle_counts(positions.size());
    for (const Triangle& triangle : domain.topology().triangles) {
        const auto [a, b, c] = corners_of(positions, triangle);
        const double length = ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3;
        for (const std::int32_t vertex : triangle) {
            lengths[vertex] += length;
            ++triangle_counts[vertex];
        }
    }
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (triangle_counts[i] > 0) lengths[i] /= triangle_counts[i];
    }
    return lengths;
}

}  // namespace

std::vector<double> triangle_densities(const Domain& domain, bool follows_edges, double mean) {
    if (!follows_edges && !domain.has_strengths()) return {};
    std::vector<double> lengths;
    if (follows_edges) lengths = local_edge_lengths(domain);
    const auto limited = [](double ratio) {
        return std::clamp(ratio, 1 / kLargestDetailRatio, kLargestDetailRatio);
    };
    std::vector<double> densities;
    densities.reserve(domain.topology().triangles.size());
    for (const auto& [a, b, c] : domain.topology().triangles) {
        const double strength = (domain.strength(a) + domain.strength(b) + domain.strength(c)) / 3;
        double ratio = std::max(strength, kLeastStrength);
        if (follows_edges) ratio *= limited((lengths[a] + lengths[b] + lengths[c]) / 3 / mean);
        densities.push_back(1 / (ratio * ratio));
    }
    return densities;
}

}  // namespace tracked_mcf
