// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"

namespace tracked_mcf {

SurfaceFlow::SurfaceFlow(const Plan& plan) : part_(moving_part_of(plan.domain)) {
    const Domain& domain = plan.domain;
    report_domain(domain, report_);
    report_.has_strengths = domain.has_strengths();
    report_.zero_strength_triangles = domain.zero_strength_count();
    report_.unselected_triangles = static_cast<std::int64_t>(domain.mesh().triangles.size()) -
                                   report_.triangles - report_.zero_strength_triangles;
    report_.longest_side = longest_side(domain.surface());
    report_.step_size = plan.step_size;
    report_.asked_step_size = plan.asked_step_size;
    report_.detail_size = detail_size_for(plan.step_size, plan.iterations, plan.steps.order);
    report_.mean_edge = plan.mean_edge;
    report_.estimated_memory_bytes = static_cast<std::int64_t>(plan.expected_bytes);
}

void SurfaceFlow::end_before_last_step(Stop reason) {
    take_last_step_back();
    report_.steps.pop_back();
    report_.stop = reason;
}

}  // namespace tracked_mcf
