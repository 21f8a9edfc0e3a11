// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/experiments/slip.h"

#include <algorithm>
#include <cmath>

namespace tracked_mcf::experiments {

Slip slip_at_constrained_edges(const Flow& flow) {
    const TrackedElements& elements = flow.stepper().elements();
    Slip slip;
    double length = 0;
    double squares = 0;
    for (const CurveSample& sample : elements.curve_samples) {
        const VertexLocation location = {sample.element, sample.local.cast<double>()};
        const double distance =
            evaluate_vertex(elements, flow.state().displacement, location).norm() *
            elements.grid.cell_size;
        length += sample.weight;
        squares += sample.weight * distance * distance;
        slip.worst = std::max(slip.worst, distance);
    }
    if (length > 0) slip.rms = std::sqrt(squares / length);
    return slip;
}

}  // namespace tracked_mcf::experiments
