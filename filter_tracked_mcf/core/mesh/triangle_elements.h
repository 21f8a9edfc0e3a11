// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// Linear elements on a triangle. The stiffness between two corners is minus the weight of the
/// third one.
struct TriangleElement {
    std::array<float, 3> weights;  ///< of each corner: half its cotangent
    float mass;                    ///< of each corner: a third of the area
};

using TriangleElements = RawVector<TriangleElement>;

/// Returns linear elements in the surface's own metric. The sides of needles are made longer, all
/// three by as much, until the sum of the two shorter ones exceeds the longest one by a few per
/// cent of the local edge length: their cotangents would have no bound. Triangles of other shapes
/// are taken as they are, for only then is the flow one by mean curvature (the mollification of
/// Sharp and Crane, "A Laplacian for Nonmanifold Triangle Meshes", 2020).
///
/// `densities` multiply the mass of each triangle; none if all are 1.
TriangleElements elements_in_own_metric(const Stars& stars,
                                        const std::vector<Eigen::Vector3d>& positions,
                                        const std::vector<float>& densities);

}  // namespace tracked_mcf
