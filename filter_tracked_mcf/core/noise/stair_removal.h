// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// What becomes of a part. Labels have no noise besides their stairs.
enum class PartKind : std::uint8_t {
    Other,    ///< no label: it may have other noise
    Kept,     ///< its stairs may be its shape
    Smoothed  ///< a label without stairs
};

/// A surface after its labels are smoothed. Lengths are in edges.
struct WithoutStairs {
    std::vector<PartKind> kinds;  ///< per part
    Positions positions;          ///< only vertices of smoothed parts have moved
    /// Of the largest labels, if possible of smoothed ones: the sides of the cells, and the height
    /// of the stairs; 0 without labels.
    Eigen::Vector3d cell = Eigen::Vector3d::Zero();
    double height = 0;
    double cells = 0;    ///< inside of all smoothed parts; NaN if one is open
    int iterations = 0;  ///< of conjugate gradients

    bool has(PartKind kind) const;
};

/// Smooths the labels of a surface that are certain, or that the parameters mean; `edge` is the
/// length of an edge in mesh units, and `numbers` are the parts of the vertices.
///
/// A size of the noise between half and twice the height of stairs means them, so that they are
/// smoothed. With another one, or if the noise or a detail size is given, no part is a label.
WithoutStairs remove_stairs(const NoisySurface& surface, const std::vector<std::int32_t>& numbers,
                            double edge, const NoiseParameters& parameters);

}  // namespace tracked_mcf
