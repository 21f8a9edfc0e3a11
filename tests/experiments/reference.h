#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// The cotangent flow after some number of steps.
struct Reference {
    TriangleMesh mesh;
    std::vector<std::uint8_t> left_out;  ///< of every vertex: triangles around it have degenerated
    double smallest_quality = 0;         ///< of its triangles
};

/// After each of these numbers of steps.
std::map<int, Reference> cotangent_flow(const TriangleMesh& mesh, double step_size,
                                        const std::vector<int>& steps,
                                        BoundaryCondition boundary = BoundaryCondition::Free);

}  // namespace tracked_mcf::experiments
