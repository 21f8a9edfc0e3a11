// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "filter_tracked_mcf/core/noise/linear_elements.h"

namespace tracked_mcf {

/// What a step does. Lengths are in edges.
struct StepSettings {
    double normal_length = 0;     ///< s of the metric (linear_elements.h)
    double step_size = 0;         ///< δ for positions, a squared length
    double normal_step_size = 0;  ///< δ for normals
    /// How far a vertex may be from its start at right angles to its normal. If there is a limit, a
    /// vertex on a rim only moves along its normal.
    double sideways = std::numeric_limits<double>::infinity();
};

/// Takes a vertex back that is farther from its start, the surface's position, than
/// StepSettings::sideways allows. `plane` is the normal of its tangent plane.
void limit_sideways(const NoisySurface& surface, std::int32_t vertex, const Eigen::Vector4f& plane,
                    double sideways, Eigen::Vector3d& position);

/// Smooths surfaces that differ from one another only in their positions. Vertices start at the
/// positions of the given surface.
class Smoothing {
public:
    /// `surface` must outlive the smoothing.
    explicit Smoothing(const NoisySurface& surface) : surface_(surface), elements_(surface) {}

    /// Returns unit normals of the vertices, or zeros where there are none: N solves
    /// (M + δ L) N = M n, normalised, where n are the mean normals of the stars. This is solved
    /// twice, the second time in the metric of (X, s N). Valid until the next call.
    const Vectors& smooth_normals(const Positions& positions, const StepSettings& settings);

    /// Makes a step: smooths the normals, then the positions in their metric, and limits how far
    /// these are sideways. Returns false and makes none if it would take a vertex out of `box`: an
    /// equation of fourth order has no maximum principle, so a few vertices beside ones that stay
    /// may fly away.
    ///
    /// `heights` are perturbations of the vertices along their normals, or empty. They become what
    /// the same step makes of them in the metric of the positions, which they do not change.
    bool step(const StepSettings& settings, const Eigen::AlignedBox3d& box, Positions& positions,
              std::vector<float>& heights);
    bool step(const StepSettings& settings, const Eigen::AlignedBox3d& box, Positions& positions) {
        std::vector<float> none;
        return step(settings, box, positions, none);
    }

    /// Returns the normals of the latest call above.
    const Vectors& normals() const { return normals_; }
    /// Returns the iterations of the solvers so far.
    int iterations() const { return iterations_; }

private:
    const Vectors& normals_of_planes();

    const NoisySurface& surface_;
    LinearElements elements_;
    Vectors triangle_normals_, normals_;
    Vectors planes_;   ///< see normals_of_planes(); empty without a rim
    Vectors vectors_;  ///< mean normals, and then displacements
    int iterations_ = 0;
};

}  // namespace tracked_mcf
