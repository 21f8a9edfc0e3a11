// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/decision.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/noise/evidence.h"
#include "filter_tracked_mcf/core/noise/flatness.h"
#include "filter_tracked_mcf/core/noise/stairs.h"
#include "filter_tracked_mcf/core/noise/turns.h"
#include "filter_tracked_mcf/core/noise/wide_noise.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Vertices of the two samples. The large one has so many regions.
constexpr std::int32_t kSample = 4000, kRegion = 500, kLargeSample = 16000, kRegions = 64;

/// A surface with more flat edges than this, whose lengths vary by more than this, is modelled with
/// as few vertices as possible. Printed parts have a share of at least 0.07 of flat edges, scans
/// and noise at most 0.04. The edges of dense parts and of rasters are too alike.
constexpr double kMostFlatEdges = 0.05, kMostVariation = 0.4;
/// If so many vertices are flat, they are clean. Fewer of them may be rounded, as heights to whole
/// numbers.
constexpr double kLeastFlat = 0.4;

/// Stairs are noise of this width, relative to their height.
constexpr double kWidthOfStairs = 1.5;

/// Fewer vertices than this show no noise.
constexpr std::int64_t kLeastVertices = 100;

/// Larger surfaces have fewer candidates to choose from, and only such as share their steps.
constexpr std::int32_t kLargeSurface = 100000;

/// Returns why noise cannot be measured on a sample, or None.
NoiseStop obstacle(const Sample& sample) {
    const auto count = std::count(sample.counts.begin(), sample.counts.end(), 1);
    return count < kLeastVertices ? NoiseStop::TooFewVertices : NoiseStop::None;
}

/// Returns the stairs of a surface. A sample shows whether it may have some: looking at all of a
/// large surface takes long.
Stairs stairs_of(const NoisySurface& surface, const Sample& sample) {
    return stairs_of(sample.surface).height > 0 ? stairs_of(surface) : Stairs();
}

class Deciding {
public:
    Deciding(NoisySurface& surface, double edge, double rounding, const NoiseParameters& parameters,
             NoiseReport& report)
        : surface_(surface),
          edge_(edge),
          rounding_(rounding),
          takes_lumps_(parameters.lumps),
          report_(report),
          sample_(sample_for_candidates(surface)) {
        request().crease = crease_of(parameters.crease_angle);
        request().noise = parameters.noise / edge;
        request().detail_size = parameters.detail_size / edge;
        request().is_quick = surface.stars.count() > kLargeSurface;
        request().width = parameters.noise_size / edge;
        is_told_ = request().noise > 0 || request().detail_size > 0 || request().width > 0;
    }

    Decision decision() {
        if (request().width == 0) look_for_stairs();
        // Nothing on the surface is wider than all of it.
        const double widest = std::sqrt(std::max(1.0, 1.0 * surface_.stars.count()));
        request().width = std::clamp(request().width, 1.0, widest);
        request().is_certain = request().width > 1 || request().has_creases;
        report_.noise_size = edge_ * request().width;
        if (!is_told_) {
            hold_flat_places();
            if (!is_part_) put_spikes_back();
        }
        choose();
        if (request().has_creases) decision_.kind = NoiseKind::Stairs;
        return std::move(decision_);
    }

private:
    NoiseRequest& request() { return decision_.request; }

    /// Stairs say what the noise is if they are certain.
    void look_for_stairs() {
        const Stairs stairs = stairs_of(surface_, sample_);
        report_.stairs = edge_ * stairs.height;
        request().has_creases = stairs.are_certain;
        if (!request().has_creases) return;
        request().width = kWidthOfStairs * stairs.height;
        is_told_ = true;
    }

    /// Takes the places that are exactly flat for clean, and reports how flat the others are.
    void hold_flat_places() {
        const Flatness flatness = flatness_of(surface_.stars, surface_.positions, rounding_);
        report_.flat_edges = flatness.edges;
        is_part_ = flatness.edges > kMostFlatEdges &&
                   variation_of_edges(surface_.stars, surface_.positions) > kMostVariation;
        const std::vector<float>& share = flatness.share;
        const auto flat = std::count(share.begin(), share.end(), 1.0F);
        if (static_cast<double>(flat) < kLeastFlat * static_cast<double>(share.size())) return;
        for (std::size_t i = 0; i < share.size(); ++i) {
            if (share[i] != 1 || surface_.fidelity[i] == 0) continue;
            surface_.fidelity[i] = 0;
            has_flat_places_ = true;
        }
        if (has_flat_places_) sample_ = sample_for_candidates(surface_);
    }

    void put_spikes_back() {
        std::vector<Spike>& spikes = decision_.spikes;
        spikes = spikes_of(surface_);
        if (spikes.empty()) return;
        for (Spike& spike : spikes) std::swap(surface_.positions[spike.vertex], spike.place);
        sample_ = sample_for_candidates(surface_);
    }

    /// Sets the kind of noise and what suits it, or why there is none.
    void choose() {
        // There may be noise in one place of a part that has none elsewhere.
        const bool only_in_places = is_part_ && !takes_lumps_;
        if (!only_in_places && !measure()) return;
        const Candidate& candidate = decision_.choice.candidate;
        if (decision_.is_measured()) decision_.kind = decision_.choice.kind;
        const NoiseKind kind = decision_.kind;
        if (is_told_ || (candidate.steps > 0 && kind == NoiseKind::Varying)) return;
        const Evidence evidence = examined();
        const bool shows_noise = candidate.steps > 0 || kind == NoiseKind::Varying;
        if (shows_noise && is_pattern(evidence, kind)) {
            decision_.choice = decision_.usual = {};
            decision_.kind = NoiseKind::White;
        } else if (candidate.steps > 0 && kind == NoiseKind::Outliers) {
            return;
        }
        // Single vertices show a part of noise that is a little wider.
        const bool is_white = candidate.steps > 0;
        decision_.is_rare = evidence.is_white_in_places;
        if (!only_in_places && asks_for_shared_noise(evidence, is_white)) {
            if (measure()) decision_.kind = NoiseKind::Shared;
        } else if (decision_.is_rare) {
            decision_.kind = NoiseKind::Varying;
        } else if (only_in_places) {
            decision_.stop = NoiseStop::ModelledPart;
        }
    }

    /// Looks at how heights depend on the length of waves, and on the place.
    Evidence examined() {
        enter_phase(0.1, "Looking for noise that neighbours share");
        const Evidence evidence =
            evidence_of(sample_of_many_places(surface_), request().crease, rounding_);
        report_.evenness = evidence.evenness > 0 ? evidence.evenness : kNoNumber;
        return evidence;
    }

    /// Asks for the removal of noise that neighbours share, if there is some. `beside_white`:
    /// single vertices show noise, too.
    bool asks_for_shared_noise(const Evidence& evidence, bool beside_white) {
        SharedNoise noise = shared_noise_of(evidence, beside_white);
        if (noise.width == 0 && takes_lumps_) noise = lumps_of(evidence);
        if (noise.width == 0) return false;
        is_shared_ = request().is_certain = true;
        request().width = noise.width;
        request().noise = noise.height;
        report_.noise_size = edge_ * noise.width;
        return true;
    }

    /// Sets the choice that a sample shows, or why there is none. Reports the noise, as measured
    /// with the usual creases and nothing else that the user may ask for.
    bool measure() {
        enter_phase(0, "Measuring the noise");
        std::optional<Clusters> clusters;  // if the noise is wide
        if (request().width > 1) clusters = clusters_of_width(surface_, request().width);
        const NoiseStop hindrance = obstacle(clusters ? clusters->sample : sample_);
        const bool is_told = (request().noise > 0 && !is_shared_) || request().detail_size > 0;
        if (hindrance != NoiseStop::None && (!is_told || clusters)) {
            // The others are held as they are flat.
            decision_.stop = has_flat_places_ ? NoiseStop::NoNoise : hindrance;
            return false;
        }
        const auto choice_for = [&](const NoiseRequest& request) {
            return clusters ? candidate_of_width(*clusters, request)
                            : best_candidate(sample_, request);
        };
        const double usual = crease_of(NoiseParameters().crease_angle);
        const bool is_usual = !is_told && request().crease == usual;
        if (!is_usual && hindrance == NoiseStop::None) {
            NoiseRequest without = request();
            without.crease = usual;
            without.noise = without.detail_size = 0;
            decision_.usual = choice_for(without);
            request().measured_noise = decision_.usual.noise;
        }
        decision_.choice = choice_for(request());
        if (is_usual) decision_.usual = decision_.choice;
        report_.noise = edge_ * decision_.usual.noise;
        return true;
    }

    NoisySurface& surface_;
    const double edge_, rounding_;
    const bool takes_lumps_;
    NoiseReport& report_;
    Sample sample_;
    Decision decision_;
    bool has_flat_places_ = false;
    bool is_part_ = false;    ///< modelled with as few vertices as possible
    bool is_told_ = false;    ///< whether the user says what the noise is, or stairs do
    bool is_shared_ = false;  ///< whether the request is for noise that the evidence shows
};

}  // namespace

Decision decide(NoisySurface& surface, double edge, double rounding,
                const NoiseParameters& parameters, NoiseReport& report) {
    return Deciding(surface, edge, rounding, parameters, report).decision();
}

Sample sample_for_candidates(const NoisySurface& surface, const std::vector<float>& fidelities) {
    return sample_of(surface, kSample, fidelities, kRegion);
}

Sample sample_of_many_places(const NoisySurface& surface, const std::vector<float>& fidelities) {
    return sample_of(surface, kLargeSample, fidelities, kLargeSample / kRegions);
}

}  // namespace tracked_mcf
