// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/candidate.h"
#include "filter_tracked_mcf/core/pi.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tracked_mcf {

namespace {

/// The share of the time that steps take.
constexpr double kShareOfSteps = 0.8;

/// Returns (δ k²)² for the waves whose amplitude `steps` steps halve.
double square_of_halved_waves(int steps) {
    return std::expm1(std::log(2.0) / steps);
}

/// Makes the steps of `candidates[first]` and of all that share them.
void make_steps(const NoisySurface& surface, const std::vector<Candidate>& candidates,
                std::size_t first, const Positions& start, Perturbation perturbation,
                Results& results) {
    const auto shares = [&](const Candidate& other) {
        return share_steps(candidates[first], other);
    };
    int steps = 0;
    for (const Candidate& candidate : candidates) {
        if (shares(candidate)) steps = std::max(steps, candidate.steps);
    }
    Smoothing smoothing(surface);
    const Eigen::AlignedBox3d box = confinement(surface.positions);
    StepSettings settings = candidates[first].settings;
    Positions positions = start;
    int made = 0;
    for (int step = 1; step <= steps; ++step) {
        enter_phase((step - 1.0) / steps,
                    "Step " + std::to_string(step) + " of " + std::to_string(steps));
        if (make_step(settings, [&] {
                return smoothing.step(settings, box, positions, perturbation.heights);
            })) {
            ++made;
        }
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (candidates[i].steps != step || !shares(candidates[i])) continue;
            results.positions[i] = positions;
            results.made[i].settings.step_size = settings.step_size;
            results.made[i].steps = made;
            if (!results.perturbed.empty())
                results.perturbed[i] = perturbed(positions, perturbation);
            if (i == 0) results.normals = smoothing.normals();
        }
    }
    results.iterations += smoothing.iterations();
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

Positions perturbed(const Positions& positions, const Perturbation& perturbation) {
    Positions moved(positions.size());
    parallel_for_rows(static_cast<std::int64_t>(moved.size()), [&](std::int32_t vertex) {
        moved[vertex] =
            positions[vertex] + perturbation.scale * perturbation.heights[vertex] *
                                    perturbation.normals[vertex].head<3>().cast<double>();
    });
    return moved;
}

Results apply(const NoisySurface& surface, const std::vector<Candidate>& candidates,
              const Positions& start, const Perturbation& perturbation) {
    const auto count = static_cast<double>(candidates.size());
    Results results{std::vector<Positions>(candidates.size(), start), candidates, {}, {}, 0};
    if (!perturbation.heights.empty()) {
        results.perturbed.assign(candidates.size(), perturbed(start, perturbation));
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto is_made = [&](const Candidate& other) {
            return share_steps(candidates[i], other);
        };
        const auto begin = candidates.begin(), end = begin + static_cast<std::ptrdiff_t>(i);
        if (std::any_of(begin, end, is_made)) continue;
        const auto done = static_cast<double>(i);
        const ProgressSpan span(kShareOfSteps * done / count, kShareOfSteps * (done + 1) / count);
        make_steps(surface, candidates, i, start, perturbation, results);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (candidates[i].sharpening.iterations == 0) continue;
        enter_phase(kShareOfSteps + (1 - kShareOfSteps) * static_cast<double>(i) / count,
                    "Sharpening the creases");
        const Eigen::AlignedBox3d box = confinement(surface.positions);
        for (std::vector<Positions>* const of : {&results.positions, &results.perturbed}) {
            if (of->empty()) continue;
            sharpen(surface, candidates[i].sharpening, candidates[i].settings.sideways, box,
                    (*of)[i]);
        }
    }
    return results;
}

}  // namespace tracked_mcf
