// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/candidate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// The share of the time that steps take.
constexpr double kShareOfSteps = 0.8;

/// Returns (δ k²)² for the waves whose amplitude `steps` steps halve.
double square_of_halved_waves(int steps) {
    return std::expm1(std::log(2.0) / steps);
}

/// Indices of candidates.
using Group = std::vector<std::size_t>;

/// Returns groups of those candidates that are alike.
template <class Alike>
std::vector<Group> groups_of(const std::vector<Candidate>& candidates, const Alike& are_alike) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
            return are_alike(candidates[group[0]], candidates[i]);
        });
        if (found == groups.end()) {
            groups.push_back({i});
        } else {
            found->push_back(i);
        }
    }
    return groups;
}

/// Calls body(i) for groups. Loops over a small surface do not share their work among threads, so
/// its groups do.
template <class Body>
void for_each_group(const NoisySurface& surface, std::size_t count, const Body& body) {
    const bool is_small = chunk_count(surface.stars.count()) < 2 * kChunksWorthThreads;
    const auto groups = static_cast<std::int64_t>(count);
    parallel_for(groups, body, is_small ? 2 : groups + 1);
}

/// Makes the steps of candidates that share them. Returns the number of the solvers' iterations.
int make_steps(const NoisySurface& surface, const std::vector<Candidate>& candidates,
               const Group& group, const Perturbation& perturbation, Results& results) {
    int steps = 0;
    for (const std::size_t i : group) steps = std::max(steps, candidates[i].steps);
    Smoothing smoothing(surface);
    const Eigen::AlignedBox3d box = confinement(surface.positions);
    StepSettings settings = candidates[group[0]].settings;
    Positions positions = surface.positions;
    std::vector<float> heights = perturbation.heights;
    int made = 0;
    for (int step = 0; step <= steps; ++step) {
        if (step > 0) {
            enter_phase((step - 1.0) / steps,
                        "Step " + std::to_string(step) + " of " + std::to_string(steps));
            const bool is_made = make_step(
                settings, [&] { return smoothing.step(settings, box, positions, heights); });
            made += is_made ? 1 : 0;
        }
        for (const std::size_t i : group) {
            if (candidates[i].steps != step) continue;
            results.positions[i] = positions;
            results.made[i].settings.step_size = settings.step_size;
            results.made[i].steps = made;
            if (!heights.empty()) results.responses[i] = heights;
            if (i == 0) results.normals = smoothing.normals();
        }
    }
    return smoothing.iterations();
}

/// Sharpens candidates that are the same positions until then, and have the same width.
void sharpen_group(const NoisySurface& surface, const std::vector<Candidate>& candidates,
                   Group group, const Perturbation& perturbation, Results& results) {
    const Candidate& first = candidates[group[0]];
    std::stable_sort(group.begin(), group.end(), [&](std::size_t a, std::size_t b) {
        return candidates[a].sharpening.iterations < candidates[b].sharpening.iterations;
    });
    std::vector<int> iterations;
    for (const std::size_t i : group) iterations.push_back(candidates[i].sharpening.iterations);
    Positions start = std::move(results.positions[group[0]]);
    const auto sharpen_start = [&](const auto& take) {
        sharpen(surface, first.sharpening.width, iterations, first.settings.sideways,
                confinement(surface.positions), start, take);
    };
    sharpen_start([&](std::size_t i, Positions sharpened) {
        results.positions[group[i]] = std::move(sharpened);
    });
    if (perturbation.heights.empty()) return;
    const std::vector<float> heights = std::move(results.responses[group[0]]);
    const auto along = [&](std::int32_t vertex) -> Eigen::Vector3d {
        return perturbation.scale * perturbation.normals[vertex].head<3>().cast<double>();
    };
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        start[vertex] += double{heights[vertex]} * along(vertex);
    });
    const double square = perturbation.scale * perturbation.scale;
    sharpen_start([&](std::size_t i, const Positions& sharpened) {
        const Positions& plain = results.positions[group[i]];
        std::vector<float>& response = results.responses[group[i]];
        response.resize(plain.size());
        parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
            response[vertex] =
                static_cast<float>((sharpened[vertex] - plain[vertex]).dot(along(vertex)) / square);
        });
    });
}

}  // namespace

bool share_steps(const Candidate& a, const Candidate& b) {
    return a.settings.normal_length == b.settings.normal_length &&
           a.settings.step_size == b.settings.step_size;
}

double step_size_of_candidate(double detail_size, int steps) {
    const double wave = detail_size / (2 * kPi);
    return wave * wave * std::sqrt(square_of_halved_waves(steps));
}

double detail_size_of(const Candidate& candidate) {
    if (candidate.steps == 0) return 0;
    return 2 * kPi *
           std::sqrt(candidate.settings.step_size /
                     std::sqrt(square_of_halved_waves(candidate.steps)));
}

Results apply(const NoisySurface& surface, const std::vector<Candidate>& candidates,
              const Perturbation& perturbation) {
    Results results;
    results.positions.resize(candidates.size());
    results.made = candidates;
    if (!perturbation.heights.empty()) results.responses.resize(candidates.size());
    const std::vector<Group> groups = groups_of(candidates, share_steps);
    std::vector<int> iterations(groups.size());
    for_each_group(surface, groups.size(), [&](std::int64_t i) {
        const auto done = static_cast<double>(i), all = static_cast<double>(groups.size());
        const ProgressSpan span(kShareOfSteps * done / all, kShareOfSteps * (done + 1) / all);
        iterations[i] = make_steps(surface, candidates, groups[i], perturbation, results);
    });
    results.iterations = std::accumulate(iterations.begin(), iterations.end(), 0);
    const std::vector<Group> sharpened = groups_of(candidates, [](const Candidate& a,
                                                                  const Candidate& b) {
        return share_steps(a, b) && a.steps == b.steps && a.sharpening.width == b.sharpening.width;
    });
    for_each_group(surface, sharpened.size(), [&](std::int64_t i) {
        if (candidates[sharpened[i][0]].sharpening.iterations == 0) return;
        const double done = static_cast<double>(i) / static_cast<double>(sharpened.size());
        enter_phase(kShareOfSteps + (1 - kShareOfSteps) * done, "Sharpening the creases");
        sharpen_group(surface, candidates, sharpened[i], perturbation, results);
    });
    return results;
}

}  // namespace tracked_mcf
