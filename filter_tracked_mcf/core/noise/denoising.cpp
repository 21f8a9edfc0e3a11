// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/denoising.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/clusters.h"
#include "filter_tracked_mcf/core/noise/cross_validation.h"
#include "filter_tracked_mcf/core/noise/fidelities.h"
#include "filter_tracked_mcf/core/noise/local_choice.h"
#include "filter_tracked_mcf/core/noise/unevenness.h"

namespace tracked_mcf {

namespace {

/// Vertices of the sample on which treatments are tried.
constexpr std::int32_t kSample = 4000, kPatch = 500;

/// Stairs are noise of this width, relative to their height.
constexpr double kWidthOfStairs = 1.5;

/// Clusters with a radius of one side are so many edges wide.
constexpr double kWidthOfRadius = 3;

/// Fewer vertices than this show no noise. Nor do those of which creases take more than this share
/// of the area; they take at most 0.42 on the meshes of tests/experiments.
constexpr std::int64_t kLeastVertices = 100;
constexpr double kMostCreases = 0.5;

/// How far vertices may move sideways, relative to the noise. Most noise that is the same in all
/// directions needs no more.
constexpr double kSideways = 2;

/// Larger surfaces have fewer treatments to choose from, and only such as share their steps.
constexpr std::int32_t kLargeSurface = 100000;

/// How often a surface is treated with fidelities.
int rounds_of(NoiseKind kind) {
    return kind == NoiseKind::Outliers ? 3 : 2;
}

/// A vertex with less fidelity than this is an outlier.
constexpr float kFidelityOfOutliers = 0.1F;

/// The size of normals' smoothing along which residuals are measured.
constexpr double kNormalStepSize = 2;

/// Returns the share of the area in triangles whose vertices' normals differ by a crease.
double crease_share(const Stars& stars, const Positions& positions, const Vectors& normals,
                    double crease) {
    const auto least = static_cast<float>(crease * crease);
    double all = 0, sharp = 0;
    for (const Triangle& t : stars.triangles) {
        const Eigen::Vector4f &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
        const auto [p, q, r] = corners_of(positions, t);
        const double area = twice_vector_area(p, q, r).norm();
        const float turn =
            std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
        all += area;
        if (turn >= least) sharp += area;
    }
    return all > 0 ? sharp / all : 0;
}

/// Returns why noise cannot be measured on a sample, or None.
NoiseStop obstacle(const Sample& sample) {
    const auto count = std::count(sample.counts.begin(), sample.counts.end(), 1);
    return count < kLeastVertices ? NoiseStop::TooFewVertices : NoiseStop::None;
}

/// Looks for what may be noise though there is none from vertex to vertex.
void report_unevenness(const NoisySurface& surface, const NoiseWishes& wishes, double edge,
                       NoiseReport& report) {
    enter_phase(0.4, "Looking for stairs and lumps");
    const Unevenness found = unevenness_of(surface, wishes);
    report.stairs = edge * found.stairs;
    report.lump_width = edge * found.width;
    report.lump_height = edge * found.height;
}

/// Returns how far a treatment has moved each vertex along the normals of its result.
std::vector<float> heights_of(const NoisySurface& surface, const Positions& treated) {
    Smoothing smoothing(surface);
    const Vectors& normals = smoothing.smooth_normals(treated, {0, 0, kNormalStepSize});
    std::vector<float> heights(treated.size());
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        const Eigen::Vector3d normal = normals[vertex].head<3>().cast<double>();
        heights[vertex] =
            static_cast<float>((treated[vertex] - surface.positions[vertex]).dot(normal));
    });
    return heights;
}

/// Treats a surface again and again, with the fidelities that its residuals show.
void treat_with_fidelities(NoisySurface& surface, NoiseWishes wishes, NoiseKind kind,
                           Treatment& treatment, Treated& treated, NoiseReport& report) {
    wishes.is_certain = true;
    const std::vector<float> strengths = surface.fidelity;
    const double sideways = treatment.settings.sideways;
    for (int round = 0; round < rounds_of(kind); ++round) {
        const ProgressSpan span(1.0 * round / rounds_of(kind), (round + 1.0) / rounds_of(kind));
        const std::vector<float> fidelities =
            fidelities_of(surface.stars, heights_of(surface, treated.positions[0]), kind);
        treatment = best_treatment(sample_of(surface, kSample, fidelities), wishes).treatment;
        treatment.settings.sideways = sideways;
        for (std::size_t i = 0; i < fidelities.size(); ++i) {
            surface.fidelity[i] = fidelities[i] * strengths[i];
        }
        const int iterations = treated.iterations;
        treated = treat(surface, {treatment}, surface.positions);
        treated.iterations += iterations;
        if (kind != NoiseKind::Outliers) continue;
        report.outliers = std::count_if(fidelities.begin(), fidelities.end(), [](float fidelity) {
            return fidelity < kFidelityOfOutliers;
        });
    }
    surface.fidelity = strengths;
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

/// Returns the treatment of noise wider than an edge, as clusters show it.
Choice treatment_of_width(const Clusters& clusters, NoiseWishes wishes) {
    const double edge = clusters.edge;
    wishes.noise /= edge;
    wishes.detail_size /= edge;
    wishes.width = std::max(1.0, wishes.width / edge);
    Choice choice = best_treatment(clusters.sample, wishes);
    StepSettings& settings = choice.treatment.settings;
    settings.normal_length *= edge;
    settings.step_size *= edge * edge;
    settings.normal_step_size *= edge * edge;
    choice.treatment.sharpening.iterations =
        static_cast<int>(std::lround(choice.treatment.sharpening.iterations * edge * edge));
    choice.noise *= edge;
    return choice;
}

/// Returns the width of the noise, at least an edge: the one that is wished for, or that of stairs.
double width_of_noise(const NoisySurface& surface, const Sample& sample, double wish,
                      NoiseReport& report) {
    // All of a large surface takes long.
    if (wish > 0 || stairs_of(sample.surface).height == 0) return std::max(1.0, wish);
    const Stairs stairs = stairs_of(surface);
    if (!stairs.are_certain) return 1;
    report.stairs = stairs.height;
    return std::max(1.0, kWidthOfStairs * stairs.height);
}

/// Returns a choice's treatments, the one for the whole surface first.
std::vector<Treatment> treatments_of(const Choice& choice, double sideways) {
    std::vector<Treatment> treatments = {choice.treatment};
    treatments.insert(treatments.end(), choice.others.begin(), choice.others.end());
    for (Treatment& treatment : treatments) treatment.settings.sideways = sideways;
    return treatments;
}

}  // namespace

double crease_of(double angle) {
    const double radian = std::acos(-1.0) / 180;
    return 2 * std::sin(angle * radian / 2);
}

Positions denoised(NoisySurface& surface, double edge, const NoiseParameters& parameters,
                   NoiseReport& report) {
    enter_phase(0, "Measuring the noise");
    NoiseWishes wishes;
    wishes.crease = crease_of(parameters.crease_angle);
    wishes.noise = parameters.noise / edge;
    wishes.detail_size = parameters.detail_size / edge;
    wishes.is_quick = surface.stars.count() > kLargeSurface;
    const Sample sample = sample_of(surface, kSample, {}, kPatch);
    wishes.width = width_of_noise(surface, sample, parameters.noise_size / edge, report);
    wishes.is_certain = wishes.width > 1 || report.stairs > 0;
    report.stairs *= edge;
    report.noise_size = edge * wishes.width;
    const bool is_measured = wishes.noise == 0 && wishes.detail_size == 0 && !wishes.is_certain;
    report.noise = parameters.noise;
    Clusters clusters{{{{{}, 0}, {}, {}}, {}, {}}, 1};
    if (wishes.width > 1) clusters = clusters_of_width(surface, wishes.width);
    if (wishes.noise == 0 && wishes.detail_size == 0) {
        report.stop = obstacle(wishes.width > 1 ? clusters.sample : sample);
    } else {
        report.stop = NoiseStop::None;
    }
    if (report.stop != NoiseStop::None) return surface.positions;
    const Choice choice =
        wishes.width > 1 ? treatment_of_width(clusters, wishes) : best_treatment(sample, wishes);
    if (wishes.noise == 0) report.noise = edge * choice.noise;
    if (choice.treatment.steps == 0) {
        report.stop = NoiseStop::NoNoise;
        report_unevenness(surface, wishes, edge, report);
        return surface.positions;
    }
    const std::vector<Treatment> treatments =
        treatments_of(choice, parameters.along_normals ? 0 : kSideways * choice.noise);
    Treatment treatment = treatments.front();
    Perturbation perturbation;
    if (treatments.size() > 1) {
        perturbation = perturbation_of(surface, treatment.settings, choice.noise);
    }
    Treated treated;
    {
        const ProgressSpan span(0.2, 0.5);
        treated = treat(surface, treatments, surface.positions,
                        wishes.is_quick ? perturbation : Perturbation());
    }
    if (wishes.crease > 0) {
        report.crease_share =
            crease_share(surface.stars, treated.positions[0], treated.normals, wishes.crease);
    }
    if (is_measured && report.crease_share > kMostCreases) {
        report.stop = NoiseStop::TooManyCreases;
        report.noise = 0;
        return surface.positions;
    }
    NoiseKind kind = choice.kind;
    if (treatments.size() > 1 && is_uneven(surface, perturbation, treated.positions[0])) {
        kind = NoiseKind::Varying;
    }
    Positions positions;
    const ProgressSpan span(0.5, 1);
    if (is_measured && kind != NoiseKind::Even) {
        treat_with_fidelities(surface, wishes, kind, treatment, treated, report);
    } else if (treatments.size() > 1) {
        if (treated.twins.empty()) {
            Treated twins = treat(surface, treatments, perturbed(surface.positions, perturbation));
            treated.twins.swap(twins.positions);
            treated.iterations += twins.iterations;
        }
        treated.positions[0] = chosen_locally(surface, perturbation, treated);
    }
    report.steps = treatment.steps;
    report.sharpenings = treatment.sharpening.iterations;
    report.iterations = treated.iterations;
    report.detail_size = edge * detail_size_of(treatment);
    return std::move(treated.positions[0]);
}

}  // namespace tracked_mcf
