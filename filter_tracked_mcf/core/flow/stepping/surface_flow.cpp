// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"

#include <tuple>

namespace tracked_mcf {

SurfaceFlow::SurfaceFlow(const Plan& plan)
    : selection_(plan.domain.selection()),
      one_copies_(one_copy_of_each_vertex(plan.domain.topology())),
      encloses_volume_(plan.domain.encloses_volume()) {
    const Domain& domain = plan.domain;
    std::tie(report_.vertices, report_.constrained_vertices) = domain.vertex_counts();
    report_.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report_.has_strengths = domain.has_strengths();
    report_.zero_strength_triangles = domain.zero_strength_count();
    report_.unselected_triangles = static_cast<std::int64_t>(domain.mesh().triangles.size()) -
                                   report_.triangles - report_.zero_strength_triangles;
    report_.oriented_consistently = domain.topology().is_oriented_consistently();
    report_.boundary_edges = domain.boundary_edge_count();
    report_.cracks = domain.topology().cracks;
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
