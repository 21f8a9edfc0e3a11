// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/denoising.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/noise/decision.h"
#include "filter_tracked_mcf/core/noise/fidelities.h"
#include "filter_tracked_mcf/core/noise/local_choice.h"
#include "filter_tracked_mcf/core/noise/turns.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Creases that take more than this share of the area are noise; they take at most 0.42 on the
/// meshes of tests/research/experiments.
constexpr double kMostCreases = 0.5;

/// How far vertices may move sideways, relative to the noise. Most noise that is the same in all
/// directions needs no more.
constexpr double kSideways = 2;

/// How often a surface with outliers is smoothed anew.
constexpr int kRounds = 3;

/// The size of normals' smoothing along which residuals are measured.
constexpr double kStepOfNormals = 2;

/// Gives held vertices the mean height of their neighbours that are free, so that windows know
/// the noise beside them.
void fill_held(const NoisySurface& surface, std::vector<float>& heights) {
    const Stars& stars = surface.stars;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (!surface.is_held(vertex)) continue;
        float sum = 0, count = 0;
        for_each_neighbour(stars, vertex, [&](std::int32_t neighbour) {
            if (surface.is_held(neighbour)) return;
            sum += std::abs(heights[neighbour]);
            ++count;
        });
        if (count > 0) heights[vertex] = sum / count;
    }
}

/// Returns how far a candidate has moved each vertex along the normals of its result.
std::vector<float> heights_of(const NoisySurface& surface, const Positions& smoothed) {
    Smoothing smoothing(surface);
    const Vectors& normals = smoothing.smooth_normals(smoothed, {0, 0, kStepOfNormals});
    std::vector<float> heights(smoothed.size());
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        const Eigen::Vector3d normal = normals[vertex].head<3>().cast<double>();
        heights[vertex] =
            static_cast<float>((smoothed[vertex] - surface.positions[vertex]).dot(normal));
    });
    fill_held(surface, heights);
    return heights;
}

/// Removes the noise of a surface as decided, and reports on it.
class Denoising {
public:
    Denoising(NoisySurface& surface, double edge, bool along_normals, Decision decision,
              NoiseReport& report)
        : surface_(surface),
          edge_(edge),
          decision_(std::move(decision)),
          sideways_(along_normals ? 0 : kSideways * decision_.choice.noise),
          report_(report) {
        report_.stop = decision_.stop;
    }

    Positions result() {
        if (report_.stop == NoiseStop::None) smooth();
        return report_.stop == NoiseStop::None ? std::move(results_.positions[0])
                                               : surface_.positions;
    }

private:
    /// Applies the candidate, and what the kind of noise needs besides.
    void smooth() {
        NoiseKind kind = decision_.kind;
        const Choice& choice = decision_.choice;
        Perturbation perturbation;
        if (kind != NoiseKind::Varying) {
            if (!has_candidate(choice)) return;
            std::vector<Candidate> candidates = {choice.candidate};
            candidates.insert(candidates.end(), choice.others.begin(), choice.others.end());
            if (candidates.size() > 1) {
                perturbation = perturbation_of(surface_, choice.candidate.settings, choice.noise);
            }
            const ProgressSpan span(0.2, 0.5);
            apply_candidates(candidates, perturbation);
        }
        if (report_.stop != NoiseStop::None) return;
        const ProgressSpan span(0.5, 1);
        if (results_.positions.size() > 1) {
            if (is_uneven(surface_, perturbation, results_.positions[0])) {
                kind = NoiseKind::Varying;
            } else {
                results_.positions[0] = chosen_locally(surface_, perturbation, results_);
            }
        }
        if (kind == NoiseKind::Varying) {
            smooth_by_local_noise(choice.candidate.steps > 0 || decision_.is_rare);
        }
        if (kind == NoiseKind::Outliers) smooth_without_outliers();
        if (report_.stop != NoiseStop::None) return;
        report_.kind = decision_.kind == NoiseKind::Stairs ? NoiseKind::Stairs : kind;
        const Candidate& made = results_.made[0];
        report_.smoothing_steps = made.steps;
        report_.sharpening_steps = made.sharpening.iterations;
        report_.solver_iterations = results_.iterations;
        report_.detail_size = edge_ * detail_size_of(made);
    }

    /// Returns whether there is a candidate. If not, it is detail that the surface has, or the
    /// creases that the user asks for are everywhere.
    bool has_candidate(const Choice& choice) {
        if (choice.candidate.steps > 0) return true;
        if (decision_.request.crease > 0 && decision_.usual.candidate.steps > 0) {
            const Vectors normals = Smoothing(surface_).smooth_normals(
                surface_.positions, decision_.usual.candidate.settings);
            if (has_too_many_creases(Turns(surface_.stars, surface_.positions, normals)))
                return false;
        }
        report_.stop = NoiseStop::NoNoise;
        return false;
    }

    /// Applies candidates to the surface, and reports the creases that the first candidate leaves.
    /// Too many of them are noise.
    void apply_candidates(std::vector<Candidate> candidates,
                          const Perturbation& perturbation = {}) {
        for (Candidate& candidate : candidates) candidate.settings.sideways = sideways_;
        const int iterations = results_.iterations;
        results_ = apply(surface_, candidates, perturbation);
        results_.iterations += iterations;
        if (decision_.request.crease == 0) return;
        Turns turns(surface_.stars, results_.positions[0], results_.normals);
        if (decision_.is_measured()) {
            has_too_many_creases(std::move(turns));
        } else {
            report_.crease_share = turns.share_of(decision_.request.crease);
        }
    }

    /// Returns whether creases are so many that they are noise, and reports them.
    bool has_too_many_creases(Turns turns) {
        report_.crease_share = turns.share_of(decision_.request.crease);
        if (report_.crease_share <= kMostCreases) return false;
        report_.stop = NoiseStop::TooManyCreases;
        report_.median_turn = turns.median_angle();
        return true;
    }

    /// Smooths the surface with fidelities, as suits a sample that has them, too.
    void smooth_with_fidelities(const std::vector<float>& fidelities, NoiseRequest request) {
        request.measured_noise = 0;  // with fidelities it is another
        // A small sample may miss noise that is in few places.
        const Choice choice =
            best_candidate(decision_.is_rare ? sample_of_many_places(surface_, fidelities)
                                             : sample_for_candidates(surface_, fidelities),
                           request);
        if (!has_candidate(choice)) return;
        const std::vector<float> strengths = surface_.fidelity;
        for (std::size_t i = 0; i < fidelities.size(); ++i) surface_.fidelity[i] *= fidelities[i];
        apply_candidates({choice.candidate});
        surface_.fidelity = strengths;
    }

    void smooth_by_local_noise(bool is_certain) {
        Positions moved = surface_.positions;
        Smoothing(surface_).step(trial_settings(), confinement(surface_.positions), moved);
        NoiseRequest request = decision_.request;
        request.is_certain = is_certain;
        request.is_doubtful = !is_certain;
        smooth_with_fidelities(fidelities_to_noise(surface_.stars, heights_of(surface_, moved)),
                               request);
    }

    void smooth_without_outliers() {
        NoiseRequest request = decision_.request;
        request.is_certain = true;
        for (int round = 0; round < kRounds; ++round) {
            const ProgressSpan span(1.0 * round / kRounds, (round + 1.0) / kRounds);
            const std::vector<float> fidelities =
                fidelities_to_outliers(surface_.stars, heights_of(surface_, results_.positions[0]));
            smooth_with_fidelities(fidelities, request);
            report_.outliers = std::count_if(fidelities.begin(), fidelities.end(), is_outlier);
        }
    }

    NoisySurface& surface_;
    const double edge_;
    const Decision decision_;
    const double sideways_;
    NoiseReport& report_;
    Results results_;
};

}  // namespace

Positions denoised(NoisySurface& surface, double edge, double rounding,
                   const NoiseParameters& parameters, NoiseReport& report) {
    const std::vector<float> fidelities = surface.fidelity;
    Decision decision = decide(surface, edge, rounding, parameters, report);
    const std::vector<Spike> spikes = std::move(decision.spikes);
    Positions positions =
        Denoising(surface, edge, parameters.along_normals, std::move(decision), report).result();
    if (!spikes.empty()) {
        if (report.stop != NoiseStop::None) report.kind = NoiseKind::Outliers;
        report.stop = NoiseStop::None;
        report.outliers += static_cast<std::int64_t>(spikes.size());
        for (const Spike& tip : spikes) surface.positions[tip.vertex] = tip.place;
    }
    surface.fidelity = fidelities;
    return positions;
}

}  // namespace tracked_mcf
