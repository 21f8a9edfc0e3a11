// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/densities.h"

#include <algorithm>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

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

std::vector<double> triangle_densities(const Domain& domain, bool follows_edges) {
    if (!follows_edges && !domain.has_strengths()) return {};
    std::vector<double> lengths;
    if (follows_edges) lengths = local_edge_lengths(domain);
    const double mean = mean_edge_length(domain.surface());
    const auto limited = [](double ratio) {
        return std::clamp(ratio, 1 / kLargestDetailRatio, kLargestDetailRatio);
    };
    std::vector<double> densities;
    densities.reserve(domain.topology().triangles.size());
    for (const auto& [a, b, c] : domain.topology().triangles) {
        double ratio = limited((domain.strength(a) + domain.strength(b) + domain.strength(c)) / 3);
        if (follows_edges) ratio *= limited((lengths[a] + lengths[b] + lengths[c]) / 3 / mean);
        densities.push_back(1 / (ratio * ratio));
    }
    return densities;
}

std::vector<float> element_densities(const TrackedElements& elements,
                                     const std::vector<double>& of_triangle,
                                     const RawVector<FragmentEntry>& fragments) {
    const std::int32_t count = elements.finest().element_count();
    std::vector<float> densities(static_cast<std::size_t>(count) + kElementBatch, 1.0F);
    parallel_for_rows(count, [&](std::int32_t element) {
        double area = 0, mass = 0;
        std::int64_t sample = elements.sample_begin[element];
        for (std::int64_t i = elements.fragment_begin[element];
             i < elements.fragment_begin[element + 1]; ++i) {
            const std::int64_t end = sample + elements.fragments[i].sample_count;
            for (; sample < end; ++sample) {
                area += elements.samples.weight(sample);
                mass += elements.samples.weight(sample) * of_triangle[fragments[i].triangle];
            }
        }
        if (area > 0) densities[element] = static_cast<float>(mass / area);
    });
    return densities;
}

}  // namespace tracked_mcf
