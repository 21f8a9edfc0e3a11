// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "filter_tracked_mcf/core/noise/linear_elements.h"

namespace tracked_mcf {

/// What a step does. Lengths are in edges.
struct StepSettings {
    double normal_length = 0;     ///< s of the metric (linear_elements.h)
    double step_size = 0;         ///< δ for positions, a squared length
    double normal_step_size = 0;  ///< δ for normals
};

/// Smooths surfaces that differ from one another only in their positions.
class Smoothing {
public:
    /// `surface` must outlive the smoothing; its positions are not used.
    explicit Smoothing(const NoisySurface& surface) : surface_(surface), elements_(surface) {}

    /// Returns unit normals of the vertices, or zeros where there are none: N solves
    /// (M + δ L) N = M n, normalised, where n are the mean normals of the stars. This is solved
    /// twice, the second time in the metric of (X, s N). Valid until the next call.
    const Vectors& smooth_normals(const Positions& positions, const StepSettings& settings);

    /// Makes a step: smooths the normals, and then the positions in their metric. Returns false and
    /// makes none if it would take a vertex out of `box`: an equation of fourth order has no
    /// maximum principle, so a few vertices beside ones that stay may fly away.
    bool step(const StepSettings& settings, const Eigen::AlignedBox3d& box, Positions& positions);

    /// Returns the normals of the latest call above.
    const Vectors& normals() const { return normals_; }
    /// Returns the iterations of conjugate gradients so far.
    int iterations() const { return iterations_; }

private:
    const NoisySurface& surface_;
    LinearElements elements_;
    Vectors normals_;
    Vectors vectors_;  ///< mean normals, and then displacements
    int iterations_ = 0;
};

}  // namespace tracked_mcf
