// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/wide_noise.h"

#include <algorithm>
#include <cmath>

namespace tracked_mcf {

namespace {

/// Vertices of the sample, and of each region, for each vertex of a cluster.
constexpr double kClusters = 4000, kClustersOfRegion = 500;

/// The iterations of sharpening grow with the squared width, up to this number.
constexpr double kMostSharpenings = 600;

/// Clusters with a radius of one side are so many edges wide.
constexpr double kWidthOfRadius = 3;

}  // namespace

Clusters clusters_of_width(const NoisySurface& surface, double width) {
    const double all = surface.stars.count(), vertices = std::min(width * width, all);
    const auto times = [&](double count) {
        return static_cast<std::int32_t>(std::min(count * vertices, all));
    };
    const int radius = std::max(1, static_cast<int>(std::sqrt(vertices) / kWidthOfRadius));
    return clusters_of(sample_of(surface, times(kClusters), {}, times(kClustersOfRegion)), radius);
}

Choice candidate_of_width(const Clusters& clusters, NoiseRequest request) {
    const double edge = clusters.edge;
    request.noise /= edge;
    request.measured_noise /= edge;
    request.detail_size /= edge;
    request.width = std::max(1.0, request.width / edge);
    Choice choice = best_candidate(clusters.sample, request);
    StepSettings& settings = choice.candidate.settings;
    settings.normal_length *= edge;
    settings.step_size *= edge * edge;
    settings.normal_step_size *= request.has_creases ? edge * edge : edge;
    int& sharpenings = choice.candidate.sharpening.iterations;
    sharpenings =
        static_cast<int>(std::min(std::round(sharpenings * edge * edge), kMostSharpenings));
    choice.noise *= edge;
    return choice;
}

}  // namespace tracked_mcf
