// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/surface_flow.h"

namespace tracked_mcf {

void describe(const Plan& plan, FlowReport& report) {
    const Domain& domain = plan.domain;
    const std::vector<std::uint8_t> counted = one_copy_of_each_vertex(domain.topology());
    const std::vector<std::uint8_t>& constrained = domain.constrained_vertices();
    for (std::size_t i = 0; i < counted.size(); ++i) {
        report.vertices += counted[i];
        if (counted[i] != 0 && constrained[i] != 0) ++report.constrained_vertices;
    }
    report.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report.has_strengths = domain.has_strengths();
    report.zero_strength_triangles = domain.zero_strength_count();
    report.unselected_triangles = static_cast<std::int64_t>(domain.mesh().triangles.size()) -
                                  report.triangles - report.zero_strength_triangles;
    report.oriented_consistently = domain.topology().is_oriented_consistently();
    report.boundary_edges = domain.boundary_edge_count();
    report.cracks = domain.topology().cracks;
    report.longest_side = longest_side(domain.surface());
    report.step_size = plan.step_size;
    report.asked_step_size = plan.asked_step_size;
    report.detail_size = detail_size_for(plan.step_size, plan.iterations, plan.steps.order);
    report.mean_edge = plan.mean_edge;
    report.estimated_memory_bytes = static_cast<std::int64_t>(plan.expected_bytes);
}

}  // namespace tracked_mcf
