// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/flow.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/memory/memory_check.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/octree/automatic_depth.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"

namespace tracked_mcf {

namespace {

/// The numbers of substeps in which a step that has failed is made again.
constexpr int kSubsteps[] = {1, 4, 16};

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

}  // namespace

struct Flow::Start {
    ClippedSurface surface;
    double estimated_bytes;
    int resolving_depth;  ///< see FlowReport
};

Flow::Start Flow::start(const Domain& domain, const FlowParameters& parameters,
                        const std::optional<Grid>& grid) {
    if (!grid) enter_setup_phase(kChooseGrid);
    const Grid cube = grid ? *grid : enclosing_grid(domain.surface(), parameters.depth);
    const SurfaceSize size = size_of(domain);
    const MemoryCheck memory = check_of(size, cube, parameters);
    const int resolving = resolving_depth(domain.surface(), cube, parameters);
    enter_setup_phase(kClipTriangles);
    const auto clip = [&] {
        // Depth 0 asks for the automatic depth.
        if (cube.depth == 0) return clip_at_automatic_depth(domain, size, cube, resolving, memory);
        memory.before_flow(cube.depth);
        return clip_to_grid(domain.surface(), cube);
    };
    ClippedSurface surface = clip();
    const double bytes = memory.flow_bytes(surface.grid.depth);
    return {std::move(surface), bytes, resolving};
}

Flow::Flow(const Domain& domain, const FlowParameters& parameters, const std::optional<Grid>& grid)
    : Flow(domain, parameters, start(domain, parameters, grid)) {}

Flow::Flow(const TriangleMesh& mesh, const FlowParameters& parameters,
           const std::optional<Grid>& grid)
    : Flow(Domain(mesh, parameters.boundary), parameters, grid) {}

Flow::Flow(const Domain& domain, const FlowParameters& parameters, Start start)
    : parameters_(parameters),
      care_{parameters.tolerance},
      stepper_(domain, std::move(start.surface), parameters),
      state_(stepper_.start()) {
    if (parameters.preserve != Preserve::None) preserver_.emplace(domain, parameters, stepper_);
    fill_report(domain);
    report_.resolving_depth = start.resolving_depth;
    report_.estimated_memory_bytes = static_cast<std::int64_t>(start.estimated_bytes);
}

void Flow::fill_report(const Domain& domain) {
    const TrackedElements& elements = stepper_.elements();
    report_.vertices = elements.referenced_vertex_count;
    report_.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report_.has_strengths = domain.has_strengths();
    report_.zero_strength_triangles = domain.zero_strength_count();
    report_.unselected_triangles = static_cast<std::int64_t>(domain.mesh().triangles.size()) -
                                   report_.triangles - report_.zero_strength_triangles;
    report_.degenerate_triangles = elements.degenerate_triangle_count;
    report_.oriented_consistently = domain.topology().is_oriented_consistently();
    report_.boundary_edges = domain.boundary_edge_count();
    report_.constrained_vertices = elements.constrained_vertex_count;
    report_.depth = elements.grid.depth;
    report_.cell_size = elements.grid.cell_size;
    report_.step_size = stepper_.size().in_mesh_units;
    report_.asked_step_size = stepper_.asked_size().in_mesh_units;
    report_.detail_size =
        detail_size_for(report_.step_size, parameters_.iterations, parameters_.order);
    report_.cells = count_cells(elements.finest());
    report_.elements = elements.finest().element_count();
    report_.unknowns = elements.finest().unknown_count();
    report_.constrained_unknowns = stepper_.locked_unknown_count();
    report_.fragments = elements.fragment_count;
    report_.split_triangles = elements.split_triangle_count;
    report_.samples = static_cast<std::int64_t>(elements.samples.size());
}

bool Flow::step() {
    StepReport report;
    Care care = care_;
    before_substep_.reset();
    StepResult next = stepper_.advance(state_, stepper_.size(), care, report);
    if (is(next, Stop::Vanished)) {
        end_before_last_step(Stop::Vanished);
        return false;
    }
    for (const int substeps : kSubsteps) {
        if (!is(next, Stop::StepFailed)) break;
        care = {std::min(parameters_.tolerance, kCarefulTolerance), true};
        next = advance_in_substeps(substeps, care, report);
    }
    if (preserver_ && std::holds_alternative<FlowState>(next)) {
        next = preserver_->restore(before_substep_ ? *before_substep_ : state_,
                                   std::get<FlowState>(std::move(next)), care, report);
    }
    if (const Stop* const reason = std::get_if<Stop>(&next)) {
        report_.stop = *reason;
        return false;
    }
    before_ = std::exchange(state_, std::get<FlowState>(std::move(next)));
    report_.steps.push_back(report);
    return true;
}

StepResult Flow::advance_in_substeps(int substeps, const Care& care, StepReport& report) {
    stepper_.forget_solutions();
    before_substep_.reset();
    const StepSize size = 1.0 / substeps * stepper_.size();
    StepReport again;
    StepResult result = Stop::NothingMoves;
    const FlowState* from = &state_;
    for (int substep = 0; substep < substeps && from != nullptr; ++substep) {
        StepResult next = stepper_.advance(*from, size, care, again);
        if (substep > 0) before_substep_ = std::get<FlowState>(result);
        if (substep > 0 && is(next, Stop::NothingMoves)) break;
        result = std::move(next);
        from = std::get_if<FlowState>(&result);
    }
    replace_attempt(report, again);
    return result;
}

void Flow::end_before_last_step(Stop reason) {
    state_ = std::move(before_);
    report_.steps.pop_back();
    report_.stop = reason;
}

void Flow::restart_with_care() {
    state_ = stepper_.start();
    stepper_.forget_solutions();
    care_.tolerance = std::min(parameters_.tolerance, kCarefulTolerance);
    report_.steps.clear();
    report_.stop = Stop::None;
}

void Flow::move_vertices(std::vector<Eigen::Vector3d>& positions) const {
    add_at_vertices(elements(), state_.displacement, positions);
}

std::vector<Eigen::Vector3d> Flow::velocities(std::size_t vertex_count) {
    std::vector<Eigen::Vector3d> velocities(vertex_count, Eigen::Vector3d::Zero());
    if (parameters_.quality != Quality::MeanCurvature) return velocities;
    if (state_.velocity.size() == 0) {
        StepReport ignored;
        const StepSize& size = stepper_.size();
        const StepResult next = stepper_.advance(
            state_, std::min(1.0, kShortStepInCells / size.in_cells) * size, care_, ignored);
        const auto* const state = std::get_if<FlowState>(&next);
        if (state == nullptr) return velocities;
        state_.velocity = state->velocity;
    }
    add_at_vertices(elements(), state_.velocity, velocities);
    if (elements().densities.empty()) return velocities;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::int32_t element = elements().vertices[vertex].element;
        if (element != VertexLocation::kNoElement)
            velocities[vertex] *= elements().densities[element];
    }
    return velocities;
}

}  // namespace tracked_mcf
