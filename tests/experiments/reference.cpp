// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/experiments/reference.h"

#include <algorithm>

#include "tests/support/cotangent_flow.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

std::map<int, Reference> cotangent_flow(const TriangleMesh& mesh, double step_size,
                                        const std::vector<int>& steps, BoundaryCondition boundary) {
    std::map<int, Reference> references;
    CotangentFlow flow(mesh, step_size, boundary);
    const int last = *std::max_element(steps.begin(), steps.end());
    for (int step = 1; step <= last; ++step) {
        flow.step();
        if (std::count(steps.begin(), steps.end(), step) == 0) continue;
        references[step] = {flow.mesh(), vertices_around(mesh, flow.degenerated()),
                            flow.smallest_quality()};
    }
    return references;
}

}  // namespace tracked_mcf::experiments
