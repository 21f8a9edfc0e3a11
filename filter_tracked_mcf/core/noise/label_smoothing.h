// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/noise/labels.h"

namespace tracked_mcf {

/// The steps of the smoothing.
inline constexpr int kStepsOfLabels = 3;

/// Labels after their stairs are smoothed.
struct SmoothLabels {
    Positions positions;  ///< in edges of the whole surface
    /// Per part: whether it is a label rather than a model of steps.
    std::vector<std::uint8_t> are_certain;
    double cells = 1;    ///< of the labels that one is wide, if the labels are on a finer grid
    int iterations = 0;  ///< of conjugate gradients
};

/// Smooths the stairs of labels. `crease` is the difference of unit normals across the least
/// crease, 0 without creases.
///
/// Any surface within half a cell of the border may have been the shape, so no vertex moves farther
/// along any side. Stairs are as often above the shape as below. So what vertices move along their
/// normals on average over some five cells is the shape, and is given back. So is the volume of
/// each part. Flat sides keep their planes. If vertices would go farther, cells are larger: then
/// the labels were resampled to a finer grid, which is turned against their own.
///
/// The result tells whether a part is a label. Its stars have many kinds, and lie on a smooth
/// surface afterwards. A model of steps has few kinds, or keeps its creases. Parts that are too
/// small to tell are what the largest part is.
SmoothLabels without_stairs(const Labels& labels, double crease, bool along_normals);

}  // namespace tracked_mcf
