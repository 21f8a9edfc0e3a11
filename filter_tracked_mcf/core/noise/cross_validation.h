// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/noise/candidate.h"
#include "filter_tracked_mcf/core/noise/fidelities.h"
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// What the user asks for. Lengths are in edges.
struct NoiseRequest {
    double crease = 0;  ///< difference of unit normals across the least crease; 0: no creases
    double noise = 0;   ///< standard deviation; 0: unknown
    double measured_noise = 0;  ///< what a sample has shown of it; 0: not yet measured
    double detail_size = 0;     ///< see NoiseParameters::detail_size; 0: what the noise needs
    double width = 1;           ///< of the noise, at least 1
    bool has_creases = false;   ///< whether the noise has creases, as stairs have
    bool is_certain = false;    ///< whether noise is removed even if it may be detail
    bool is_doubtful = false;   ///< whether what may be detail passed for detail before
    bool is_quick = false;      ///< whether Choice::others are few and share the candidate's steps
};

/// How to remove the noise of a surface, as a sample shows.
struct Choice {
    Candidate candidate;  ///< without steps if there is hardly any noise
    double noise = 0;     ///< its standard deviation, in edges
    /// If it varies, a candidate suits only a sample with fidelities, and there may be none.
    NoiseKind kind = NoiseKind::White;
    /// Candidates that suit some places better, the most useful ones first. None if the noise is
    /// not even, or if the request sets how much is removed.
    std::vector<Candidate> others;
};

/// Returns the candidate that suits a sample best.
///
/// A candidate F, a function of n noisy heights x, is the better the smaller its robust generalised
/// cross-validation is, |F(x) - x|² / n / (1 - div F / n)² (γ + (1 - γ) |F'|² / n) with the
/// Frobenius norm of the derivative F' (Lukas, "Robust generalized cross-validation", 2006). It
/// needs no knowledge of the noise. If the noise σ is known, Stein's estimate of the risk takes its
/// place, |F(x) - x|² / n + 2 σ² div F / n (1981). Differences F(x + ε z) - F(x) for random signs z
/// tell the divergence and the norm (Ramani, Blu and Unser, "Monte-Carlo SURE", 2008).
///
/// Without a request, a candidate that takes little of what seems to be noise is none: then it is
/// detail.
///
/// Noise of some width is like white noise on a mesh with edges of this length: all lengths of a
/// candidate are in units of the width, and random signs are averaged over it. Normals are not, so
/// that creases show beside wide noise; but they are if the noise has creases.
///
/// Where the sample's vertices have fidelities, heights count by their roots, so that the noise is
/// the same everywhere.
Choice best_candidate(const Sample& sample, const NoiseRequest& request);

/// Returns a short step that keeps no creases.
StepSettings trial_settings();

}  // namespace tracked_mcf
