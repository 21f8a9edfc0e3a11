// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// Smooths the curves that the rim of a surface consists of, and keeps their corners.
///
/// Each coordinate x of a curve's vertices becomes x + d, where
/// (F M + δ² L M⁻¹ L) (x + d) = F M x, M and L are the mass and the stiffness of linear elements on
/// the curve, and F are the fidelities: waves of ten edges lose half of their height. The metric is
/// that of (X, s T) with smooth tangents T, so corners that turn by `crease` or more are long.
/// `crease` is a difference of unit tangents; 0 keeps no corners. Vertices without a fidelity stay,
/// and those where curves meet. Where a vertex would leave `box`, the step is smaller.
void smooth_rim(const NoisySurface& surface, double crease, const Eigen::AlignedBox3d& box,
                Positions& positions);

}  // namespace tracked_mcf
