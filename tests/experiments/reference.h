// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// The cotangent flow after a number of steps.
struct Reference {
    TriangleMesh mesh;
    std::vector<std::uint8_t> left_out;  ///< for each vertex: triangles around it have degenerated
    double smallest_quality = 0;         ///< of its triangles
};

/// Returns the cotangent flow after each of these numbers of steps.
std::map<int, Reference> cotangent_flow(const TriangleMesh& mesh, double step_size,
                                        const std::vector<int>& steps,
                                        BoundaryCondition boundary = BoundaryCondition::Free);

}  // namespace tracked_mcf::experiments
