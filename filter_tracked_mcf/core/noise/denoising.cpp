// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/denoising.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/clusters.h"
#include "filter_tracked_mcf/core/noise/cross_validation.h"
#include "filter_tracked_mcf/core/noise/fidelities.h"
#include "filter_tracked_mcf/core/noise/local_choice.h"
#include "filter_tracked_mcf/core/noise/unevenness.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// Vertices of the sample on which candidates are tried.
constexpr std::int32_t kSample = 4000, kPatch = 500;

/// Stairs are noise of this width, relative to their height.
constexpr double kWidthOfStairs = 1.5;

/// The iterations of sharpening grow with the squared width, up to this number.
constexpr double kMostSharpenings = 600;

/// Clusters with a radius of one side are so many edges wide.
constexpr double kWidthOfRadius = 3;

/// Fewer vertices than this show no noise. Nor do those of which creases take more than this share
/// of the area; they take at most 0.42 on the meshes of tests/research/experiments.
constexpr std::int64_t kLeastVertices = 100;
constexpr double kMostCreases = 0.5;

/// How far vertices may move sideways, relative to the noise. Most noise that is the same in all
/// directions needs no more.
constexpr double kSideways = 2;

/// Larger surfaces have fewer candidates to choose from, and only such as share their steps.
constexpr std::int32_t kLargeSurface = 100000;

/// How often a surface with outliers is smoothed anew.
constexpr int kRounds = 3;

/// The size of normals' smoothing along which residuals are measured.
constexpr double kStepOfNormals = 2;

constexpr double kRadian = kPi / 180;

/// Returns the angle of a difference of unit normals, in degrees: the inverse of crease_of().
double angle_of(double chord) {
    return 2 * std::asin(std::min(chord / 2, 1.0)) / kRadian;
}

/// How much normals differ across the triangles of a surface.
class Turns {
public:
    Turns(const Stars& stars, const Positions& positions, const Vectors& normals) {
        turns_.reserve(stars.triangles.size());
        for (const Triangle& t : stars.triangles) {
            const Eigen::Vector4f &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
            const auto [p, q, r] = corners_of(positions, t);
            const float square =
                std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
            turns_.push_back({std::sqrt(square), twice_vector_area(p, q, r).norm()});
            area_ += turns_.back().area;
        }
    }

    /// Returns the share of the area in triangles that a crease crosses.
    double share_of(double crease) const {
        double sharp = 0;
        for (const Turn& turn : turns_) {
            if (turn.chord >= crease) sharp += turn.area;
        }
        return area_ > 0 ? sharp / area_ : 0;
    }

    /// Returns the angle by which the normals of half the area differ, degrees.
    double median_angle() {
        std::sort(turns_.begin(), turns_.end(),
                  [](const Turn& a, const Turn& b) { return a.chord < b.chord; });
        auto turn = turns_.begin();
        double left = area_ / 2 - turn->area;
        while (left > 0) left -= (++turn)->area;
        return angle_of(turn->chord);
    }

private:
    struct Turn {
        double chord;  ///< largest difference of the unit normals at two corners
        double area;
    };

    std::vector<Turn> turns_;
    double area_ = 0;
};

/// Returns why noise cannot be measured on a sample, or None.
NoiseStop obstacle(const Sample& sample) {
    const auto count = std::count(sample.counts.begin(), sample.counts.end(), 1);
    return count < kLeastVertices ? NoiseStop::TooFewVertices : NoiseStop::None;
}

/// Looks for what may be noise though there is none from vertex to vertex.
void report_unevenness(const NoisySurface& surface, const NoiseRequest& request, double edge,
                       NoiseReport& report) {
    enter_phase(0.4, "Looking for stairs and lumps");
    const Unevenness found = unevenness_of(surface, request);
    report.stairs = edge * found.stairs;
    report.lump_width = edge * found.width;
    report.lump_height = edge * found.height;
}

/// Gives vertices that stay the mean height of their neighbours that do not, so that windows know
/// the noise beside them.
void fill_fixed(const NoisySurface& surface, std::vector<float>& heights) {
    const Stars& stars = surface.stars;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (!surface.is_fixed(vertex)) continue;
        float sum = 0, count = 0;
        for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i) {
            if (surface.is_fixed(stars.neighbours[i])) continue;
            sum += std::abs(heights[stars.neighbours[i]]);
            ++count;
        }
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
    fill_fixed(surface, heights);
    return heights;
}

/// Returns clusters of vertices that are a little narrower than noise of some width, on a sample.
Clusters clusters_of_width(const NoisySurface& surface, double width) {
    const double all = surface.stars.count(), vertices = std::min(width * width, all);
    const auto times = [&](double count) {
        return static_cast<std::int32_t>(std::min(count * vertices, all));
    };
    const int radius = std::max(1, static_cast<int>(std::sqrt(vertices) / kWidthOfRadius));
    return clusters_of(sample_of(surface, times(kSample), {}, times(kPatch)), radius);
}

/// Returns the candidate of noise wider than an edge, as clusters show it.
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
    settings.normal_step_size *= edge * edge;
    int& sharpenings = choice.candidate.sharpening.iterations;
    sharpenings =
        static_cast<int>(std::min(std::round(sharpenings * edge * edge), kMostSharpenings));
    choice.noise *= edge;
    return choice;
}

/// Returns the width of the noise, at least an edge: the one that is wished for, or that of stairs.
double width_of_noise(const NoisySurface& surface, const Sample& sample, double wish,
                      NoiseReport& report) {
    // Nothing on the surface is wider than all of it.
    wish = std::min(wish, std::sqrt(static_cast<double>(surface.stars.count())));
    // All of a large surface takes long.
    if (wish > 0 || stairs_of(sample.surface).height == 0) return std::max(1.0, wish);
    const Stairs stairs = stairs_of(surface);
    if (!stairs.are_certain) return 1;
    report.stairs = stairs.height;
    return std::max(1.0, kWidthOfStairs * stairs.height);
}

/// Removes the noise of a surface, and reports on it.
class Denoising {
public:
    Denoising(NoisySurface& surface, double edge, const NoiseParameters& parameters,
              NoiseReport& report)
        : surface_(surface),
          edge_(edge),
          along_normals_(parameters.along_normals),
          report_(report),
          sample_(sample_of(surface, kSample, {}, kPatch)) {
        request_.crease = crease_of(parameters.crease_angle);
        request_.noise = parameters.noise / edge;
        request_.detail_size = parameters.detail_size / edge;
        request_.is_quick = surface.stars.count() > kLargeSurface;
        request_.width = width_of_noise(surface, sample_, parameters.noise_size / edge, report);
        request_.is_certain = request_.width > 1 || report.stairs > 0;
        report.stairs *= edge;
        report.noise_size = edge * request_.width;
    }

    Positions result() {
        const Choice choice = first_choice();
        if (report_.stop != NoiseStop::None) return surface_.positions;
        NoiseKind kind = is_measured() ? choice.kind : NoiseKind::Even;
        sideways_ = along_normals_ ? 0 : kSideways * choice.noise;
        Perturbation perturbation;
        if (kind != NoiseKind::Varying) {
            if (!has_candidate(choice)) return surface_.positions;
            std::vector<Candidate> candidates = {choice.candidate};
            candidates.insert(candidates.end(), choice.others.begin(), choice.others.end());
            if (candidates.size() > 1) {
                perturbation = perturbation_of(surface_, choice.candidate.settings, choice.noise);
            }
            const ProgressSpan span(0.2, 0.5);
            apply_candidates(candidates, request_.is_quick ? perturbation : Perturbation());
        }
        if (report_.stop != NoiseStop::None) return surface_.positions;
        const ProgressSpan span(0.5, 1);
        if (results_.positions.size() > 1) {
            if (is_uneven(surface_, perturbation, results_.positions[0])) {
                kind = NoiseKind::Varying;
            } else {
                choose_locally(perturbation);
            }
        }
        if (kind == NoiseKind::Varying) smooth_by_local_noise(choice.candidate.steps > 0);
        if (kind == NoiseKind::Outliers) smooth_without_outliers();
        if (report_.stop != NoiseStop::None) return surface_.positions;
        const Candidate& made = results_.made[0];
        report_.smoothing_steps = made.steps;
        report_.sharpening_steps = made.sharpening.iterations;
        report_.solver_iterations = results_.iterations;
        report_.detail_size = edge_ * detail_size_of(made);
        return std::move(results_.positions[0]);
    }

private:
    /// Returns whether the mesh itself says what its noise is, from vertex to vertex.
    bool is_measured() const {
        return request_.noise == 0 && request_.detail_size == 0 && !request_.is_certain;
    }

    /// Returns the candidate that the sample shows, or sets why there is none. Reports the noise,
    /// as measured with the usual creases and nothing else that the user may ask for.
    Choice first_choice() {
        enter_phase(0, "Measuring the noise");
        std::optional<Clusters> clusters;  // if the noise is wide
        if (request_.width > 1) clusters = clusters_of_width(surface_, request_.width);
        const NoiseStop hindrance = obstacle(clusters ? clusters->sample : sample_);
        const bool is_told = request_.noise > 0 || request_.detail_size > 0;
        report_.stop = is_told && !clusters ? NoiseStop::None : hindrance;
        if (report_.stop != NoiseStop::None) return {};
        const auto choice_for = [&](const NoiseRequest& request) {
            return clusters ? candidate_of_width(*clusters, request)
                            : best_candidate(sample_, request);
        };
        const double usual = crease_of(NoiseParameters().crease_angle);
        if (!is_told && request_.crease == usual) {
            usual_ = choice_for(request_);
            report_.noise = edge_ * usual_.noise;
            return usual_;
        }
        if (hindrance == NoiseStop::None) {
            NoiseRequest request = request_;
            request.crease = usual;
            request.noise = request.detail_size = 0;
            usual_ = choice_for(request);
            request_.measured_noise = usual_.noise;
            report_.noise = edge_ * usual_.noise;
        }
        return choice_for(request_);
    }

    /// Returns whether there is a candidate. If not, it is detail that the surface has, or the
    /// creases that the user asks for are everywhere.
    bool has_candidate(const Choice& choice) {
        if (choice.candidate.steps > 0) return true;
        if (request_.crease > 0 && usual_.candidate.steps > 0) {
            const Vectors normals =
                Smoothing(surface_).smooth_normals(surface_.positions, usual_.candidate.settings);
            if (has_too_many_creases(Turns(surface_.stars, surface_.positions, normals)))
                return false;
        }
        report_.stop = NoiseStop::NoNoise;
        report_unevenness(surface_, request_, edge_, report_);
        return false;
    }

    /// Applies candidates to the surface, and reports the creases that the first candidate leaves.
    /// Too many of them are noise.
    void apply_candidates(std::vector<Candidate> candidates,
                          const Perturbation& perturbation = {}) {
        for (Candidate& candidate : candidates) candidate.settings.sideways = sideways_;
        candidates_ = std::move(candidates);
        const int iterations = results_.iterations;
        results_ = apply(surface_, candidates_, surface_.positions, perturbation);
        results_.iterations += iterations;
        if (request_.crease == 0) return;
        Turns turns(surface_.stars, results_.positions[0], results_.normals);
        if (is_measured()) {
            has_too_many_creases(std::move(turns));
        } else {
            report_.crease_share = turns.share_of(request_.crease);
        }
    }

    /// Returns whether creases are so many that they are noise, and reports them.
    bool has_too_many_creases(Turns turns) {
        report_.crease_share = turns.share_of(request_.crease);
        if (report_.crease_share <= kMostCreases) return false;
        report_.stop = NoiseStop::TooManyCreases;
        report_.median_turn = turns.median_angle();
        return true;
    }

    /// Smooths the surface with fidelities, as suits a sample that has them, too.
    void smooth_with_fidelities(const std::vector<float>& fidelities, NoiseRequest request) {
        request.measured_noise = 0;  // with fidelities it is another
        const Choice choice = best_candidate(sample_of(surface_, kSample, fidelities), request);
        if (!has_candidate(choice)) return;
        const std::vector<float> strengths = surface_.fidelity;
        for (std::size_t i = 0; i < fidelities.size(); ++i) surface_.fidelity[i] *= fidelities[i];
        apply_candidates({choice.candidate});
        surface_.fidelity = strengths;
    }

    void smooth_by_local_noise(bool is_certain) {
        Positions moved = surface_.positions;
        Smoothing(surface_).step(trial_settings(), confinement(surface_.positions), moved);
        NoiseRequest request = request_;
        request.is_certain = is_certain;
        request.is_doubtful = !is_certain;
        smooth_with_fidelities(fidelities_to_noise(surface_.stars, heights_of(surface_, moved)),
                               request);
    }

    void smooth_without_outliers() {
        NoiseRequest request = request_;
        request.is_certain = true;
        for (int round = 0; round < kRounds; ++round) {
            const ProgressSpan span(1.0 * round / kRounds, (round + 1.0) / kRounds);
            const std::vector<float> fidelities =
                fidelities_to_outliers(surface_.stars, heights_of(surface_, results_.positions[0]));
            smooth_with_fidelities(fidelities, request);
            report_.outliers = std::count_if(fidelities.begin(), fidelities.end(), is_outlier);
        }
    }

    void choose_locally(const Perturbation& perturbation) {
        if (results_.perturbed.empty()) {
            Results again =
                apply(surface_, candidates_, perturbed(surface_.positions, perturbation));
            results_.perturbed.swap(again.positions);
            results_.iterations += again.iterations;
        }
        results_.positions[0] = chosen_locally(surface_, perturbation, results_);
    }

    NoisySurface& surface_;
    const double edge_;
    const bool along_normals_;
    NoiseReport& report_;
    const Sample sample_;
    NoiseRequest request_;
    Choice usual_;  ///< with the usual creases, and without request; empty if it cannot be measured
    double sideways_ = 0;
    std::vector<Candidate> candidates_;  ///< of results_
    Results results_;
};

}  // namespace

double crease_of(double angle) {
    return 2 * std::sin(angle * kRadian / 2);
}

Positions denoised(NoisySurface& surface, double edge, const NoiseParameters& parameters,
                   NoiseReport& report) {
    return Denoising(surface, edge, parameters, report).result();
}

}  // namespace tracked_mcf
