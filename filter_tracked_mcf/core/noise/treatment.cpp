// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/treatment.h"
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

/// Makes the steps of `treatments[first]` and of all that share them.
void make_steps(const NoisySurface& surface, const std::vector<Treatment>& treatments,
                std::size_t first, const Positions& start, Perturbation perturbation,
                Treated& treated) {
    const auto shares = [&](const Treatment& other) {
        return share_steps(treatments[first], other);
    };
    int steps = 0;
    for (const Treatment& treatment : treatments) {
        if (shares(treatment)) steps = std::max(steps, treatment.steps);
    }
    Smoothing smoothing(surface);
    const Eigen::AlignedBox3d box = confinement(surface.positions);
    StepSettings settings = treatments[first].settings;
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
        for (std::size_t i = 0; i < treatments.size(); ++i) {
            if (treatments[i].steps != step || !shares(treatments[i])) continue;
            treated.positions[i] = positions;
            treated.made[i].settings.step_size = settings.step_size;
            treated.made[i].steps = made;
            if (!treated.twins.empty()) treated.twins[i] = perturbed(positions, perturbation);
            if (i == 0) treated.normals = smoothing.normals();
        }
    }
    treated.iterations += smoothing.iterations();
}

}  // namespace

bool share_steps(const Treatment& a, const Treatment& b) {
    return a.settings.normal_length == b.settings.normal_length &&
           a.settings.step_size == b.settings.step_size;
}

double step_size_of_treatment(double detail_size, int steps) {
    const double wave = detail_size / (2 * kPi);
    return wave * wave * std::sqrt(square_of_halved_waves(steps));
}

double detail_size_of(const Treatment& treatment) {
    if (treatment.steps == 0) return 0;
    return 2 * kPi *
           std::sqrt(treatment.settings.step_size /
                     std::sqrt(square_of_halved_waves(treatment.steps)));
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

Treated treat(const NoisySurface& surface, const std::vector<Treatment>& treatments,
              const Positions& start, const Perturbation& perturbation) {
    const auto count = static_cast<double>(treatments.size());
    Treated treated{std::vector<Positions>(treatments.size(), start), treatments, {}, {}, 0};
    if (!perturbation.heights.empty()) {
        treated.twins.assign(treatments.size(), perturbed(start, perturbation));
    }
    for (std::size_t i = 0; i < treatments.size(); ++i) {
        const auto is_made = [&](const Treatment& other) {
            return share_steps(treatments[i], other);
        };
        const auto begin = treatments.begin(), end = begin + static_cast<std::ptrdiff_t>(i);
        if (std::any_of(begin, end, is_made)) continue;
        const auto done = static_cast<double>(i);
        const ProgressSpan span(kShareOfSteps * done / count, kShareOfSteps * (done + 1) / count);
        make_steps(surface, treatments, i, start, perturbation, treated);
    }
    for (std::size_t i = 0; i < treatments.size(); ++i) {
        if (treatments[i].sharpening.iterations == 0) continue;
        enter_phase(kShareOfSteps + (1 - kShareOfSteps) * static_cast<double>(i) / count,
                    "Sharpening the creases");
        const Eigen::AlignedBox3d box = confinement(surface.positions);
        for (std::vector<Positions>* const of : {&treated.positions, &treated.twins}) {
            if (of->empty()) continue;
            sharpen(surface, treatments[i].sharpening, treatments[i].settings.sideways, box,
                    (*of)[i]);
        }
    }
    return treated;
}

}  // namespace tracked_mcf
