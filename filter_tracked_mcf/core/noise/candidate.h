// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/noise/sharpening.h"
#include "filter_tracked_mcf/core/noise/smoothing.h"

namespace tracked_mcf {

/// How noise is removed from a surface. Lengths are in edges.
struct Candidate {
    StepSettings settings;  ///< of every step
    int steps = 0;          ///< 0: there is hardly any noise
    Sharpening sharpening;
    /// The mean over a sample of what a vertex keeps of its height because the metric of the steps
    /// follows the noise.
    double divergence_of_metric = 0;
};

/// Returns whether candidates have the same settings, so that they begin alike.
bool share_steps(const Candidate& a, const Candidate& b);

/// Returns the step size of `steps` steps that halve the amplitude of waves of this length.
double step_size_of_candidate(double detail_size, int steps);

/// Returns the length of the waves whose amplitude the steps of a candidate halve;
/// 0 without steps.
double detail_size_of(const Candidate& candidate);

/// Perturbations of a surface's vertices along normals. They tell how a candidate answers to noise.
struct Perturbation {
    std::vector<float> heights;  ///< empty: there is none
    Vectors normals;
    double scale = 0;  ///< the perturbations are this times the heights
};

/// Calls `step`, which uses the settings, until it returns true; each time after the first with a
/// quarter of the step size. Returns false if it never does. Then the settings are as before.
template <class Step>
bool make_step(StepSettings& settings, const Step& step) {
    constexpr int most_shorter = 8;
    const double asked = settings.step_size;
    for (int i = 0; i <= most_shorter; ++i, settings.step_size /= 4) {
        if (step()) return true;
    }
    settings.step_size = asked;
    return false;
}

/// What candidates make of a surface.
struct Results {
    std::vector<Positions> positions;  ///< per candidate
    /// What was made of each candidate: fewer steps, or shorter ones, where they would have taken a
    /// vertex far away.
    std::vector<Candidate> made;
    /// Per candidate and vertex: what becomes of the heights of a perturbation; or empty.
    std::vector<std::vector<float>> responses;
    Vectors normals;     ///< of the last step of the first candidate
    int iterations = 0;  ///< of the solvers
};

/// Applies candidates to a surface, whose positions they start from. Candidates that share their
/// steps are made together. A step that would take a vertex far away is made with a smaller size. A
/// perturbation costs little, as it does not change the metric of the steps: it is a part of the
/// response only.
Results apply(const NoisySurface& surface, const std::vector<Candidate>& candidates,
              const Perturbation& perturbation = {});

}  // namespace tracked_mcf
