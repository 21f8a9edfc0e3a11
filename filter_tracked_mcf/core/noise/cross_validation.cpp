// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/cross_validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "filter_tracked_mcf/core/noise/sharpening.h"

namespace tracked_mcf {

namespace {

// The treatments that are tried. They were chosen on fandisk, cube, hand_8k, nefertiti_50k and
// armadillo_50k with noise of 0.05 to 0.7 edges.

/// Lengths s of the metric, relative to that at which the least crease is as wide as an edge.
constexpr std::array<double, 5> kNormalLengths = {0, 0.65, 1.3, 2.6, 3.9};
/// They are longer in proportion if the user gives a detail size that is larger than this.
constexpr double kDetailOfNormalLengths = 9;
constexpr std::array<double, 7> kStepSizes = {0.04, 0.075, 0.15, 0.3, 0.6, 1.2, 2.4};
constexpr int kMostSteps = 4;
/// Steps if the user gives the detail size.
constexpr int kStepsToDetailSize = 2;
/// Their widths are relative to the least crease.
constexpr std::array<Sharpening, 3> kSharpenings = {{{0.23, 3}, {0.46, 5}, {0.46, 15}}};

/// Normals are smoothed the more the larger the noise is, beginning with this one.
constexpr double kNormalStepSize = 2;
constexpr double kSmallNoise = 0.2;

/// The trial that measures the noise takes this length of the metric and this step size.
constexpr double kTrialNormalLength = 2.6, kTrialStepSize = 0.15;

/// The weight γ of robust cross-validation; without it, noise is sometimes taken for detail.
constexpr double kRobustness = 0.8;
/// Treatments that do next to nothing are not told apart.
constexpr double kLeastRest = 0.02;
/// With less noise than this, in edges, nothing is to be removed: steps would only move vertices
/// along the surface.
constexpr double kNoNoise = 1e-4;

/// The perturbation ε: relative to the noise, and the least one that exceeds rounding by far.
constexpr double kPerturbation = 0.05, kLeastPerturbation = 1e-4;
constexpr double kTrialPerturbation = 5e-3;

const double kTwoPi = 2 * std::acos(-1.0);

/// Returns (δ k²)² for the waves whose amplitude `steps` steps halve.
double halved_waves(int steps) {
    return std::expm1(std::log(2.0) / steps);
}

/// What a treatment does to the heights of the sample's vertices.
struct Effect {
    double square = 0;       ///< mean square of the movement
    double divergence = 0;   ///< mean
    double sign_square = 0;  ///< mean square of what is taken from heights of random sign
};

/// Returns the noise that a treatment shows: it takes from noise what it takes from random signs.
double noise_of(const Effect& effect) {
    return effect.sign_square > 0 ? std::sqrt(effect.square / effect.sign_square) : 0;
}

/// Positions of the sample, and of the sample with perturbed heights, before or after a treatment.
struct Twins {
    Positions plain, perturbed;
};

/// The best treatment so far.
struct Attempt {
    double score = std::numeric_limits<double>::infinity();
    Treatment treatment;
    Effect effect;
    Twins twins;
};

/// A place on the grid of treatments: in kNormalLengths and in kStepSizes.
using Place = std::array<int, 2>;

/// Tries treatments on a sample.
class Trials {
public:
    Trials(const Sample& sample, const NoiseWishes& wishes)
        : sample_(sample),
          wishes_(wishes),
          box_(confinement(sample.surface.positions)),
          smoothing_(sample.surface),
          unit_length_(wishes.crease > 0
                           ? std::max(1.0, wishes.detail_size / kDetailOfNormalLengths) /
                                 wishes.crease
                           : 0),
          noise_(wishes.noise) {
        count_ = std::count(sample.counts.begin(), sample.counts.end(), 1);
        perturb(kTrialPerturbation);
        // The second time with the normals that the noise needs.
        for (int i = 0; i < 2; ++i) measure_noise();
        perturb(std::max(kPerturbation * noise_, kLeastPerturbation));
    }

    Treatment best() {
        if (wishes_.detail_size == 0 && noise_ < kNoNoise) {
            Treatment none;
            none.noise = noise_;
            return none;
        }
        if (wishes_.detail_size > 0) {
            for (std::size_t i = 0; i < kNormalLengths.size(); ++i)
                try_steps({static_cast<int>(i), 0});
        } else {
            descend();
        }
        if (wishes_.crease > 0 && best_.treatment.steps > 0) {
            const Attempt smooth = best_;
            for (const Sharpening& sharpening : kSharpenings) try_sharpening(smooth, sharpening);
        }
        best_.treatment.noise = noise_of(best_.effect);
        return best_.treatment;
    }

private:
    StepSettings settings_for(double normal_length, double step_size) const {
        return {normal_length * unit_length_, step_size,
                kNormalStepSize * std::max(1.0, noise_ / kSmallNoise)};
    }

    /// Sets the heights' normals and their perturbation.
    void perturb(double perturbation) {
        const Positions& positions = sample_.surface.positions;
        normals_ = smoothing_.smooth_normals(positions, settings_for(kTrialNormalLength, 0));
        perturbation_ = perturbation;
        untreated_ = {positions, positions};
        parallel_for_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
            untreated_.perturbed[vertex] += perturbation * sample_.signs[vertex] * normal(vertex);
        });
    }

    void measure_noise() {
        if (wishes_.noise > 0) return;
        Twins twins = untreated_;
        step(settings_for(kTrialNormalLength, kTrialStepSize), twins);
        noise_ = noise_of(effect_of(twins));
    }

    Eigen::Vector3d normal(std::int32_t vertex) const {
        return normals_[vertex].head<3>().cast<double>();
    }

    void step(const StepSettings& settings, Twins& twins) {
        smoothing_.step(settings, box_, twins.plain);
        smoothing_.step(settings, box_, twins.perturbed);
    }

    Effect effect_of(const Twins& twins) const {
        const Positions& positions = sample_.surface.positions;
        const auto mean = [&](const auto& body) {
            const double sum =
                sum_over_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
                    return sample_.counts[vertex] != 0 ? body(vertex) : 0;
                });
            return count_ > 0 ? sum / static_cast<double>(count_) : 0;
        };
        const auto response = [&](std::int32_t vertex) {
            return (twins.perturbed[vertex] - twins.plain[vertex]).dot(normal(vertex)) /
                   perturbation_;
        };
        Effect effect;
        effect.square = mean([&](std::int32_t vertex) {
            const double height = (twins.plain[vertex] - positions[vertex]).dot(normal(vertex));
            return height * height;
        });
        effect.divergence =
            mean([&](std::int32_t vertex) { return sample_.signs[vertex] * response(vertex); });
        effect.sign_square = mean([&](std::int32_t vertex) {
            const double taken = sample_.signs[vertex] - response(vertex);
            return taken * taken;
        });
        return effect;
    }

    double score_of(const Effect& effect) const {
        if (wishes_.noise > 0) {
            return effect.square + 2 * noise_ * noise_ * effect.divergence;
        }
        const double rest = std::max(1 - effect.divergence, kLeastRest);
        // The squares of signs are 1.
        const double kept_square = effect.sign_square + 2 * effect.divergence - 1;
        return effect.square / (rest * rest) * (kRobustness + (1 - kRobustness) * kept_square);
    }

    /// Keeps an attempt if it is better than the best one. Returns its score.
    double judge(const Treatment& treatment, const Twins& twins) {
        const Effect effect = effect_of(twins);
        const double score = score_of(effect);
        if (score < best_.score) best_ = {score, treatment, effect, twins};
        return score;
    }

    /// Tries steps with these settings, one more after the other until they do not get better; as
    /// many as reach the detail size if the user gives it.
    void try_steps(const Place& place) {
        const bool sized = wishes_.detail_size > 0;
        const int most = sized ? kStepsToDetailSize : kMostSteps;
        const double wave = wishes_.detail_size / kTwoPi;
        Twins twins = untreated_;
        Treatment treatment;
        treatment.settings =
            settings_for(kNormalLengths[static_cast<std::size_t>(place[0])],
                         sized ? wave * wave * std::sqrt(halved_waves(kStepsToDetailSize))
                               : kStepSizes[static_cast<std::size_t>(place[1])]);
        for (double last = std::numeric_limits<double>::infinity(); treatment.steps < most;) {
            step(treatment.settings, twins);
            ++treatment.steps;
            if (sized && treatment.steps < most) continue;
            const double score = judge(treatment, twins);
            if (!(score < last)) return;
            last = score;
        }
    }

    /// Walks over the grid of treatments, to a better neighbour each time.
    void descend() {
        const Place sizes = {wishes_.crease > 0 ? static_cast<int>(kNormalLengths.size()) : 1,
                             static_cast<int>(kStepSizes.size())};
        std::set<Place> tried;
        const auto improves = [&](const Place& place) {
            for (std::size_t i = 0; i < place.size(); ++i) {
                if (place[i] < 0 || place[i] >= sizes[i]) return false;
            }
            if (!tried.insert(place).second) return false;
            const double before = best_.score;
            try_steps(place);
            return best_.score < before;
        };
        Place place = {sizes[0] / 2, sizes[1] / 2};
        improves(place);
        for (bool moved = true; moved;) {
            moved = false;
            for (const Place& step : {Place{0, -1}, Place{0, 1}, Place{-1, 0}, Place{1, 0},
                                      Place{-1, -1}, Place{1, 1}}) {
                const Place next = {place[0] + step[0], place[1] + step[1]};
                if (!improves(next)) continue;
                place = next;
                moved = true;
            }
        }
    }

    void try_sharpening(const Attempt& smooth, Sharpening sharpening) {
        sharpening.width *= wishes_.crease;
        Treatment treatment = smooth.treatment;
        treatment.sharpening = sharpening;
        Twins twins = smooth.twins;
        const double no_limit = treatment.settings.sideways;
        sharpen(sample_.surface, sharpening, no_limit, box_, twins.plain);
        sharpen(sample_.surface, sharpening, no_limit, box_, twins.perturbed);
        judge(treatment, twins);
    }

    const Sample& sample_;
    const NoiseWishes wishes_;
    const Eigen::AlignedBox3d box_;
    Smoothing smoothing_;
    double unit_length_;  ///< s at which the least crease is as wide as an edge
    double noise_;
    std::int64_t count_ = 0;
    Vectors normals_;
    double perturbation_ = 0;
    Twins untreated_;
    Attempt best_;
};

}  // namespace

double detail_size_of(const Treatment& treatment) {
    if (treatment.steps == 0) return 0;
    return kTwoPi *
           std::sqrt(treatment.settings.step_size / std::sqrt(halved_waves(treatment.steps)));
}

Treatment best_treatment(const Sample& sample, const NoiseWishes& wishes) {
    return Trials(sample, wishes).best();
}

}  // namespace tracked_mcf
