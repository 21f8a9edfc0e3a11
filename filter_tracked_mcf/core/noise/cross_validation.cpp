// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/cross_validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "filter_tracked_mcf/core/noise/local_choice.h"

namespace tracked_mcf {

namespace {

// The candidates that are tried. They were chosen on fandisk, cube, hand_8k, nefertiti_50k and
// armadillo_50k with noise of 0.05 to 0.7 edges.

/// Lengths s of the metric, relative to that at which the least crease is as wide as an edge.
constexpr std::array<double, 5> kNormalLengths = {0, 0.65, 1.3, 2.6, 3.9};
/// They are longer in proportion if the user gives a detail size that is larger than this.
constexpr double kDetailOfNormalLengths = 9;
constexpr std::array<double, 7> kStepSizes = {0.04, 0.075, 0.15, 0.3, 0.6, 1.2, 2.4};
constexpr int kMostSteps = 4;
/// Steps if the user gives the detail size, and the largest one: beyond it, single precision loses
/// the mass beside the square of the stiffness.
constexpr int kStepsToDetailSize = 2;
constexpr double kLargestDetailSize = 250;
/// Their widths are relative to the least crease.
constexpr std::array<Sharpening, 3> kSharpenings = {{{0.23, 3}, {0.46, 5}, {0.46, 15}}};

/// Normals are smoothed the more the larger the noise is, beginning with this one.
constexpr double kNormalStepSize = 2;
constexpr double kSmallNoise = 0.2;

/// The trial that measures the noise takes this length of the metric and this step size.
constexpr double kTrialNormalLength = 2.6, kTrialStepSize = 0.15;

/// The weight γ of robust cross-validation; without it, noise is sometimes taken for detail.
constexpr double kRobustness = 0.8;
/// Candidates that do next to nothing are not told apart.
constexpr double kLeastRest = 0.02;
/// With less noise than this, in edges, nothing is to be removed: steps would only move vertices
/// along the surface.
constexpr double kNoNoise = 1e-4;
/// Where the best candidate takes less than this share of the noise, it is detail: at most 0.51 on
/// 20 clean meshes, 0.02 to 0.31 on 9 with lumps or waves, at least 0.58 on 105 noisy ones.
constexpr double kLeastTaken = 0.55;
/// More noise than this that passes for detail may be noise that varies. If so, a candidate with
/// fidelities takes more than this share of it: at least 0.81 on a depth camera's map and on sheets
/// with five times the noise in a corner, at most 0.69 on clean meshes.
constexpr double kLargeNoise = 0.1, kLeastTakenIfDoubtful = 0.75;

/// The perturbation ε: relative to the noise, and the least one that exceeds rounding by far.
constexpr double kPerturbation = 0.05, kLeastPerturbation = 1e-4;
constexpr double kTrialPerturbation = 5e-3;

/// Places choose among so many candidates, and only if the best one keeps less than this share of
/// random heights: else it may be detail that it takes. The best of the whole sample has at most
/// 0.54 with noise of 0.1 edges or more, and at least 0.60 on clean meshes.
constexpr std::size_t kFewCandidates = 5, kFewQuickCandidates = 3;
constexpr double kMostDivergence = 0.5;
/// Neighbouring step sizes are these times each other. With them, this sharpening is tried, too.
constexpr double kBetweenStepSizes = 2;
constexpr std::size_t kSharpeningOfOthers = 1;

double square_of(double number) {
    return number * number;
}

/// What a candidate does to the heights of the sample's vertices.
struct Effect {
    double square = 0;       ///< mean square of the movement
    double divergence = 0;   ///< mean
    double sign_square = 0;  ///< mean square of what is taken from heights of random sign
};

/// Returns the noise that a candidate shows: it takes from noise what it takes from random signs.
double noise_of(const Effect& effect) {
    return effect.sign_square > 0 ? std::sqrt(effect.square / effect.sign_square) : 0;
}

/// Positions of the sample, and of the sample with perturbed heights, before or after a candidate.
struct PerturbedPair {
    Positions plain, perturbed;
    /// What becomes of the perturbation's heights, in units of the perturbation, in the metric of
    /// the plain positions.
    std::vector<float> heights;
};

/// A candidate that was tried.
struct Attempt {
    Candidate candidate;
    PerturbedPair pair;
    Effect effect;
    double score = std::numeric_limits<double>::infinity();
};

/// A place on the grid of candidates: in kNormalLengths and in kStepSizes.
using Place = std::array<int, 2>;

/// Tries candidates on a sample.
class Trials {
public:
    Trials(const Sample& sample, const NoiseRequest& request)
        : sample_(sample),
          request_(request),
          width_(request.width),
          detail_size_(std::min(request.detail_size, kLargestDetailSize)),
          signs_(sample.signs),
          box_(confinement(sample.surface.positions)),
          smoothing_(sample.surface),
          smoothing_of_perturbed_(sample.surface),
          unit_length_(request.crease > 0
                           ? std::max(1.0, detail_size_ / kDetailOfNormalLengths) / request.crease
                           : 0),
          noise_(request.noise > 0 ? request.noise : request.measured_noise) {
        count_ = std::count(sample.counts.begin(), sample.counts.end(), 1);
        widen_signs();
        perturb(kTrialPerturbation * width_);
        // The second time with the normals that the noise needs.
        for (int i = 0; i < 2; ++i) measure_noise();
        perturb(std::max(kPerturbation * noise_, kLeastPerturbation));
    }

    Choice best() {
        Choice choice;
        choice.noise = noise_;
        const bool may_be_none =
            request_.detail_size == 0 && request_.noise == 0 && !request_.is_certain;
        if (may_be_none && noise_ < kNoNoise) return choice;
        if (request_.detail_size > 0) {
            for (const double length : kNormalLengths) try_detail_size(length);
        } else {
            descend();
            // Doing nothing has no movement, and the divergence 1.
            if (request_.noise > 0 && best_.score >= 2 * noise_ * noise_) return choice;
            const double least = request_.is_doubtful ? kLeastTakenIfDoubtful : kLeastTaken;
            if (may_be_none && std::sqrt(best_.effect.square) < least * noise_) {
                if (noise_ > kLargeNoise) choice.kind = NoiseKind::Varying;
                return choice;
            }
        }
        if (best_.candidate.steps == 0) return choice;
        if (request_.crease > 0) {
            for (Attempt& attempt : sharpened(best_, {kSharpenings.begin(), kSharpenings.end()})) {
                keep(std::move(attempt));
            }
        }
        choice.candidate = best_.candidate;
        const bool is_known = request_.noise > 0 || request_.measured_noise > 0;
        choice.noise = is_known ? noise_ : noise_of(best_.effect);
        choice.kind = kind_of_noise(sample_.surface.stars, heights_of(best_.pair), sample_.counts);
        if (may_be_none && choice.kind == NoiseKind::White &&
            best_.effect.divergence < kMostDivergence) {
            choice.others = others(choice.noise);
        }
        return choice;
    }

private:
    StepSettings settings_for(double normal_length, double step_size) const {
        const double square = width_ * width_;
        return {width_ * normal_length * unit_length_, square * step_size,
                (request_.has_creases ? square : 1) * kNormalStepSize *
                    std::max(1.0, noise_ / width_ / kSmallNoise)};
    }

    /// Averages the signs over the width, and scales them to a mean square of 1.
    void widen_signs() {
        if (width_ == 1) return;
        diffuse(sample_.surface.stars, static_cast<int>(std::lround(width_ * width_)), signs_);
        const double square =
            mean_of([&](std::int32_t vertex) { return square_of(signs_[vertex]); });
        const auto scale = static_cast<float>(square > 0 ? 1 / std::sqrt(square) : 0);
        for (float& sign : signs_) sign *= scale;
    }

    /// Returns the mean over the vertices that count.
    template <class Body>
    double mean_of(const Body& body) const {
        const double sum = sum_over_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
            return sample_.counts[vertex] != 0 ? body(vertex) : 0;
        });
        return count_ > 0 ? sum / static_cast<double>(count_) : 0;
    }

    /// Sets the heights' normals and their perturbation.
    void perturb(double perturbation) {
        const Positions& positions = sample_.surface.positions;
        normals_ = smoothing_.smooth_normals(positions, settings_for(kTrialNormalLength, 0));
        perturbation_ = perturbation;
        before_ = {positions, positions, signs_};
        parallel_for_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
            before_.perturbed[vertex] +=
                perturbation / root(vertex) * signs_[vertex] * normal(vertex);
            before_.heights[vertex] /= static_cast<float>(root(vertex));
        });
    }

    /// Returns the candidates besides the best one that suit some places of the sample better.
    std::vector<Candidate> others(double noise) {
        if (request_.crease > 0 && !request_.is_quick) {
            for (const double ratio : {1 / kBetweenStepSizes, kBetweenStepSizes}) {
                const Attempt* const neighbour = best_with_step_size(ratio);
                if (neighbour == nullptr) continue;
                attempts_.push_back(
                    sharpened(*neighbour, {kSharpenings[kSharpeningOfOthers]}).front());
            }
        }
        const auto is_slow = [&](const Attempt& attempt) {
            return request_.is_quick && !share_steps(attempt.candidate, best_.candidate);
        };
        attempts_.erase(std::remove_if(attempts_.begin(), attempts_.end(), is_slow),
                        attempts_.end());
        std::vector<Risks> risks;
        std::size_t best = 0;
        for (const Attempt& attempt : attempts_) {
            if (attempt.score == best_.score) best = risks.size();
            risks.emplace_back(signs_.size());
            parallel_for_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
                const double divergence = signs_[vertex] * response(attempt.pair, vertex);
                risks.back()[vertex] = static_cast<float>(square_of(height(attempt.pair, vertex)) +
                                                          2 * noise * noise * divergence);
            });
        }
        std::vector<Candidate> candidates;
        for (const std::size_t i : best_few(
                 sample_, risks, best, request_.is_quick ? kFewQuickCandidates : kFewCandidates)) {
            if (i != best) candidates.push_back(attempts_[i].candidate);
        }
        return candidates;
    }

    /// Returns the best attempt whose step size is so many times the best one's, without
    /// sharpening, or a null pointer.
    const Attempt* best_with_step_size(double ratio) const {
        const StepSettings& settings = best_.candidate.settings;
        const Attempt* best = nullptr;
        for (const Attempt& attempt : attempts_) {
            const StepSettings& other = attempt.candidate.settings;
            const bool fits = other.normal_length == settings.normal_length &&
                              std::abs(other.step_size / settings.step_size / ratio - 1) < 0.1 &&
                              attempt.candidate.sharpening.iterations == 0;
            if (fits && (best == nullptr || attempt.score < best->score)) best = &attempt;
        }
        return best;
    }

    void measure_noise() {
        if (request_.noise > 0 || request_.measured_noise > 0) return;
        PerturbedPair pair = before_;
        step(settings_for(kTrialNormalLength, kTrialStepSize), pair);
        noise_ = noise_of(effect_of(pair));
    }

    Eigen::Vector3d normal(std::int32_t vertex) const {
        return normals_[vertex].head<3>().cast<double>();
    }

    /// Makes a step of the pair. Returns false and makes none if it would take a vertex away.
    bool step(const StepSettings& settings, PerturbedPair& pair) {
        PerturbedPair moved = pair;
        bool is_plain_made = false, is_perturbed_made = false;
        // Loops over a sample are too short to share.
        parallel_for(2, [&](std::int64_t i) {
            if (i == 0) {
                is_plain_made = smoothing_.step(settings, box_, moved.plain, moved.heights);
            } else {
                is_perturbed_made = smoothing_of_perturbed_.step(settings, box_, moved.perturbed);
            }
        });
        if (!is_plain_made || !is_perturbed_made) return false;
        pair = std::move(moved);
        return true;
    }

    Effect effect_of(const PerturbedPair& pair) const {
        Effect effect;
        effect.square =
            mean_of([&](std::int32_t vertex) { return square_of(height(pair, vertex)); });
        effect.divergence =
            mean_of([&](std::int32_t vertex) { return signs_[vertex] * response(pair, vertex); });
        effect.sign_square = mean_of([&](std::int32_t vertex) {
            return square_of(signs_[vertex] - response(pair, vertex));
        });
        return effect;
    }

    /// Returns the root of a vertex's fidelity: heights times it have the same noise everywhere.
    double root(std::int32_t vertex) const {
        const float fidelity = sample_.surface.fidelity[vertex];
        return fidelity > 0 ? std::sqrt(double{fidelity}) : 1;
    }

    std::vector<float> heights_of(const PerturbedPair& pair) const {
        std::vector<float> heights(signs_.size());
        parallel_for_rows(sample_.surface.stars.count(), [&](std::int32_t vertex) {
            heights[vertex] = static_cast<float>(height(pair, vertex));
        });
        return heights;
    }

    /// Returns how far a vertex has moved along its normal, relative to its noise.
    double height(const PerturbedPair& pair, std::int32_t vertex) const {
        return root(vertex) *
               (pair.plain[vertex] - sample_.surface.positions[vertex]).dot(normal(vertex));
    }

    /// Returns what is left of a vertex's sign.
    double response(const PerturbedPair& pair, std::int32_t vertex) const {
        return root(vertex) * (pair.perturbed[vertex] - pair.plain[vertex]).dot(normal(vertex)) /
               perturbation_;
    }

    double score_of(const Effect& effect) const {
        if (request_.noise > 0) {
            return effect.square + 2 * noise_ * noise_ * effect.divergence;
        }
        const double rest = std::max(1 - effect.divergence, kLeastRest);
        // The mean square of signs is 1.
        const double kept_square = effect.sign_square + 2 * effect.divergence - 1;
        return effect.square / (rest * rest) * (kRobustness + (1 - kRobustness) * kept_square);
    }

    /// Judges an attempt.
    Attempt attempt_of(Candidate candidate, const PerturbedPair& pair) const {
        const Effect effect = effect_of(pair);
        candidate.divergence_of_metric =
            effect.divergence - mean_of([&](std::int32_t vertex) {
                return signs_[vertex] * root(vertex) * double{pair.heights[vertex]};
            });
        return {candidate, pair, effect, score_of(effect)};
    }

    /// Keeps an attempt. Returns its score.
    double keep(Attempt attempt) {
        if (attempt.score < best_.score) best_ = attempt;
        attempts_.push_back(std::move(attempt));
        return attempts_.back().score;
    }

    /// Tries steps with these settings, one more after the other until they do not get better.
    void try_steps(const StepSettings& settings, int most) {
        PerturbedPair pair = before_;
        Candidate candidate;
        candidate.settings = settings;
        for (double last = std::numeric_limits<double>::infinity(); candidate.steps < most;) {
            if (!step(settings, pair)) return;
            ++candidate.steps;
            const double score = keep(attempt_of(candidate, pair));
            if (!(score < last)) return;
            last = score;
        }
    }

    /// Tries as many steps as reach the detail size that the user gives.
    void try_detail_size(double normal_length) {
        Candidate candidate;
        candidate.settings =
            settings_for(normal_length, step_size_of_candidate(detail_size_, kStepsToDetailSize));
        PerturbedPair pair = before_;
        for (int i = 0; i < kStepsToDetailSize; ++i) {
            const bool is_made =
                make_step(candidate.settings, [&] { return step(candidate.settings, pair); });
            candidate.steps += is_made ? 1 : 0;
        }
        if (candidate.steps > 0) keep(attempt_of(candidate, pair));
    }

    /// Walks over the grid of candidates, to a better neighbour each time.
    void descend() {
        const Place sizes = {request_.crease > 0 ? static_cast<int>(kNormalLengths.size()) : 1,
                             static_cast<int>(kStepSizes.size())};
        std::set<Place> tried;
        const auto improves = [&](const Place& place) {
            for (std::size_t i = 0; i < place.size(); ++i) {
                if (place[i] < 0 || place[i] >= sizes[i]) return false;
            }
            if (!tried.insert(place).second) return false;
            const double before = best_.score;
            try_steps(settings_for(kNormalLengths[static_cast<std::size_t>(place[0])],
                                   kStepSizes[static_cast<std::size_t>(place[1])]),
                      kMostSteps);
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

    /// Returns a smooth attempt with each of some sharpenings. Those in a row that have the same
    /// width share iterations.
    std::vector<Attempt> sharpened(const Attempt& smooth,
                                   const std::vector<Sharpening>& sharpenings) const {
        std::vector<Attempt> attempts(sharpenings.size(), smooth);
        std::vector<std::array<std::size_t, 2>> runs;  // begin and end
        for (std::size_t i = 0; i < attempts.size(); ++i) {
            Sharpening& sharpening = attempts[i].candidate.sharpening;
            sharpening = sharpenings[i];
            sharpening.width *= request_.crease;
            sharpening.iterations =
                static_cast<int>(std::lround(sharpening.iterations * width_ * width_));
            if (i == 0 || sharpenings[i].width != sharpenings[i - 1].width) runs.push_back({i, i});
            ++runs.back()[1];
        }
        const auto vertices = static_cast<std::int64_t>(signs_.size());
        Positions by_heights = smooth.pair.plain;
        parallel_for_rows(vertices, [&](std::int32_t vertex) {
            by_heights[vertex] +=
                perturbation_ * double{smooth.pair.heights[vertex]} * normal(vertex);
        });
        const std::array<const Positions*, 3> starts = {&smooth.pair.plain, &smooth.pair.perturbed,
                                                        &by_heights};
        std::vector<std::array<Positions, 3>> ends(attempts.size());
        parallel_for(static_cast<std::int64_t>(starts.size() * runs.size()), [&](std::int64_t i) {
            const std::size_t start = static_cast<std::size_t>(i) % starts.size();
            const auto [begin, end] = runs[static_cast<std::size_t>(i) / starts.size()];
            std::vector<int> iterations;
            for (std::size_t k = begin; k < end; ++k)
                iterations.push_back(attempts[k].candidate.sharpening.iterations);
            const double no_limit = std::numeric_limits<double>::infinity();
            sharpen(sample_.surface, attempts[begin].candidate.sharpening.width, iterations,
                    no_limit, box_, *starts[start],
                    [&, first = begin](std::size_t k, Positions positions) {
                        ends[first + k][start] = std::move(positions);
                    });
        });
        for (std::size_t i = 0; i < attempts.size(); ++i) {
            PerturbedPair& pair = attempts[i].pair;
            pair.plain = std::move(ends[i][0]);
            pair.perturbed = std::move(ends[i][1]);
            parallel_for_rows(vertices, [&](std::int32_t vertex) {
                pair.heights[vertex] = static_cast<float>(
                    (ends[i][2][vertex] - pair.plain[vertex]).dot(normal(vertex)) / perturbation_);
            });
            attempts[i] = attempt_of(attempts[i].candidate, pair);
        }
        return attempts;
    }

    const Sample& sample_;
    const NoiseRequest request_;
    const double width_;  ///< of the noise
    const double detail_size_;
    std::vector<float> signs_;  ///< per vertex; with a width, averaged over it
    const Eigen::AlignedBox3d box_;
    Smoothing smoothing_, smoothing_of_perturbed_;
    double unit_length_;  ///< s at which the least crease is as wide as an edge
    double noise_;
    std::int64_t count_ = 0;
    Vectors normals_;
    double perturbation_ = 0;
    PerturbedPair before_;
    std::vector<Attempt> attempts_;
    Attempt best_;
};

}  // namespace

StepSettings trial_settings() {
    return {0, kTrialStepSize, kNormalStepSize};
}

Choice best_candidate(const Sample& sample, const NoiseRequest& request) {
    return Trials(sample, request).best();
}

}  // namespace tracked_mcf
