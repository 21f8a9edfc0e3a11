// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/flow.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"

namespace tracked_mcf {

namespace {

/// The tolerance, at most, to which a step that has failed is retried.
constexpr double kCarefulTolerance = 1e-6;

/// The length of the step, in squared sides of a cell, that measures the velocity of a surface that
/// makes no step. The grid resolves no finer detail.
constexpr double kShortStepInCells = 1;

/// Replaces the numbers of an attempt by those of another one. Time and iterations are those of
/// both.
void replace_attempt(StepReport& report, StepReport again) {
    again.assemble_seconds += report.assemble_seconds;
    again.solve_seconds += report.solve_seconds;
    again.solver_iterations += report.solver_iterations;
    again.area = report.area;
    again.collapsed_samples = report.collapsed_samples;
    report = again;
}

/// Builds the elements, and frees the parts of the plan that nothing else needs.
TrackedElements elements_of(Plan& plan) {
    const std::vector<double> densities = std::move(plan.densities);
    return build_tracked_elements(plan.domain, std::move(plan.surface), plan.discretisation,
                                  densities);
}

}  // namespace

Flow::Flow(Plan plan) : stepper_(elements_of(plan), plan.steps), state_(stepper_.start()) {
    if (plan.preserve != Preserve::None) preserver_.emplace(plan.domain, plan.preserve, stepper_);
    fill_report(plan);
}

void Flow::fill_report(const Plan& plan) {
    const Domain& domain = plan.domain;
    const TrackedElements& elements = stepper_.elements();
    describe(domain, report_);
    report_.degenerate_triangles = elements.degenerate_triangle_count;
    report_.depth = elements.grid.depth;
    report_.cell_size = elements.grid.cell_size;
    report_.step_size = stepper_.size().in_mesh_units;
    report_.asked_step_size = plan.steps.size.in_mesh_units;
    report_.detail_size = detail_size_for(report_.step_size, plan.iterations, plan.steps.order);
    report_.mean_edge = plan.mean_edge;
    if (plan.steps.flow == FlowKind::Conformalized) report_.genus = genus_of(domain.topology());
    report_.resolving_depth = plan.resolving_depth;
    report_.estimated_memory_bytes = static_cast<std::int64_t>(plan.expected_bytes);
    report_.cells = count_cells(elements.finest());
    report_.elements = elements.finest().element_count();
    report_.unknowns = elements.finest().unknown_count();
    report_.constrained_unknowns = stepper_.locked_unknown_count();
    report_.fragments = elements.fragment_count;
    report_.split_triangles = elements.split_triangle_count;
    report_.samples = static_cast<std::int64_t>(elements.samples.size());
}

bool Flow::step() {
    const double tolerance = stepper_.plan().tolerance;
    const Care careful = {std::min(tolerance, kCarefulTolerance), true};
    StepReport report;
    StepResult next = advance(1, {tolerance}, report);
    if (has_stopped(next, Stop::Vanished)) {
        end_before_last_step(Stop::Vanished);
        return false;
    }
    for (const int substeps : {1, 4, 16}) {
        if (!has_stopped(next, Stop::StepFailed)) break;
        stepper_.forget_solutions();
        StepReport again;
        next = advance(substeps, careful, again);
        replace_attempt(report, again);
    }
    if (preserver_ && std::holds_alternative<FlowState>(next)) {
        next = preserver_->restore(std::get<FlowState>(std::move(next)));
    }
    if (const Stop* const reason = std::get_if<Stop>(&next)) {
        report_.stop = *reason;
        return false;
    }
    before_ = std::exchange(state_, std::get<FlowState>(std::move(next)));
    report_.steps.push_back(report);
    return true;
}

StepResult Flow::advance(int substeps, const Care& care, StepReport& report) {
    const StepSize size = 1.0 / substeps * stepper_.size();
    StepResult result = Stop::NothingMoves;
    const FlowState* from = &state_;
    for (int substep = 0; substep < substeps && from != nullptr; ++substep) {
        StepResult next = stepper_.advance(*from, size, care, report);
        if (substep > 0 && has_stopped(next, Stop::NothingMoves)) break;
        result = std::move(next);
        from = std::get_if<FlowState>(&result);
    }
    return result;
}

void Flow::end_before_last_step(Stop reason) {
    state_ = std::move(before_);
    report_.steps.pop_back();
    report_.stop = reason;
}

void Flow::move_vertices(std::vector<Eigen::Vector3d>& positions) const {
    add_at_vertices(stepper_.elements(), state_.displacement, positions);
}

std::vector<double> Flow::mean_curvatures(const SurfaceView& after, const Selection& selection) {
    std::vector<Eigen::Vector3d> curvatures = velocities(after.positions.size());
    for (Eigen::Vector3d& curvature : curvatures) curvature *= -0.5;
    return along_normals(curvatures, after, selection);
}

std::vector<Eigen::Vector3d> Flow::velocities(std::size_t vertex_count) {
    std::vector<Eigen::Vector3d> velocities(vertex_count, Eigen::Vector3d::Zero());
    if (!stepper_.plan().takes_velocities) return velocities;
    const TrackedElements& elements = stepper_.elements();
    if (state_.velocity.size() == 0) {
        StepReport ignored;
        const StepSize& size = stepper_.size();
        const StepResult next =
            stepper_.advance(state_, std::min(1.0, kShortStepInCells / size.in_cells) * size,
                             {stepper_.plan().tolerance}, ignored);
        const auto* const state = std::get_if<FlowState>(&next);
        if (state == nullptr) return velocities;
        state_.velocity = state->velocity;
    }
    add_at_vertices(elements, state_.velocity, velocities);
    if (elements.densities.empty()) return velocities;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::int32_t element = elements.vertices[vertex].element;
        if (element != VertexLocation::kNoElement)
            velocities[vertex] *= elements.densities[element];
    }
    return velocities;
}

}  // namespace tracked_mcf
