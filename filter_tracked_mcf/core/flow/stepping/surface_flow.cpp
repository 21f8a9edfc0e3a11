// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"

#include <utility>

namespace tracked_mcf {

SurfaceFlow::SurfaceFlow(Plan& plan) : mesh_(plan.mesh), surface_(std::move(plan.surface)) {
    report_surface(surface_, report_);
    report_.has_strengths = !surface_.strengths.empty();
    report_.zero_strength_triangles = surface_.counts.zero_strength;
    report_.unselected_triangles = surface_.counts.unselected;
    report_.longest_side = surface_.box.sizes().maxCoeff();
    report_.step_size = plan.step_size;
    report_.asked_step_size = plan.asked_step_size;
    report_.detail_size = detail_size_for(plan.step_size, plan.iterations, plan.steps.order);
    report_.mean_edge = surface_.edge;
    report_.estimated_memory_bytes = static_cast<std::int64_t>(plan.expected_bytes);
}

void SurfaceFlow::end_before_last_step(Stop reason) {
    take_last_step_back();
    report_.steps.pop_back();
    report_.stop = reason;
}

}  // namespace tracked_mcf
