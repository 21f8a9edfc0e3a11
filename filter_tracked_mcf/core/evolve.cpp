// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/evolve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

namespace {

// Durations for the progress bar, relative to one step.
constexpr double kSetupInSteps = 5;
constexpr double kFinishInSteps = 0.03;

/// Returns the fraction of the work that is done before this step, counted from 0.
double progress_before(int step, int iterations) {
    return (kSetupInSteps + step) / (kSetupInSteps + iterations + kFinishInSteps);
}

/// The area has grown if it did so by more than this fraction.
constexpr double kGrowth = 1e-3;

/// Sets the flow up; returns it in place, since it cannot be moved. Sets the triangles that flow.
Flow set_up(const TriangleMesh& mesh, const Inputs& inputs, FlowParameters parameters,
            Selection& moving) {
    const ProgressSpan span(0, progress_before(0, parameters.iterations));
    enter_setup_phase(kFindEdges);
    const Domain domain(mesh, inputs, parameters.boundary);
    moving = domain.selection();
    enter_setup_phase(kMeasureSurface);
    check_preservable(domain, parameters);
    if (domain.constrains_all_vertices()) {
        // Nothing can move. The cheapest set-up is enough to say so.
        parameters.depth = 1;
        parameters.separate_sheets = false;
    }
    return Flow(domain, parameters);
}

/// Positions to which a flow has moved the mesh, and the area of the triangles that flow.
struct Moved {
    std::vector<Eigen::Vector3d> positions;
    double area;
};

Moved moved_by(const Flow& flow, const TriangleMesh& mesh, const Selection& selection) {
    Moved moved{mesh.positions, 0};
    flow.move_vertices(moved.positions);
    moved.area = surface_area({moved.positions, mesh.triangles}, selection);
    return moved;
}

/// A mesh and what is to be done with it.
struct Task {
    const TriangleMesh& mesh;
    const Selection& selection;
    const FlowParameters& parameters;
    const StepObserver& on_step;
};

/// Makes all steps, or fewer if nothing is left to do. `note` follows the name of each step for the
/// user.
void make_steps(Flow& flow, const Task& task, const char* note) {
    const int iterations = task.parameters.iterations;
    for (int step = 0; step < iterations; ++step) {
        const ProgressSpan span(progress_before(step, iterations),
                                progress_before(step + 1, iterations));
        enter_phase(
            0, "Step " + std::to_string(step + 1) + " of " + std::to_string(iterations) + note);
        if (!flow.step()) return;
        if (!task.on_step) continue;
        std::vector<Eigen::Vector3d> positions = task.mesh.positions;
        flow.move_vertices(positions);
        task.on_step(step + 1, positions);
    }
}

/// Makes all steps. If the last one has made the surface vanish, which the flow itself would notice
/// only in the next step, undoes it.
Moved flow_through(Flow& flow, const Task& task, double area_before, const char* note = "") {
    make_steps(flow, task, note);
    Moved moved = moved_by(flow, task.mesh, task.selection);
    if (flow.report().stop == Stop::None && moved.area <= kVanishedArea * area_before) {
        flow.end_before_last_step(Stop::Vanished);
        moved = moved_by(flow, task.mesh, task.selection);
    }
    return moved;
}

/// Sets the report's measures of the change from `before` to `after`.
void compare(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
             const Selection& selection, FlowReport& report) {
    double largest = 0, squares = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const double square = (after[i] - before.positions[i]).squaredNorm();
        if (!std::isfinite(square)) continue;  // a vertex that no triangle uses
        squares += square;
        largest = std::max(largest, square);
    }
    report.largest_displacement = std::sqrt(largest);
    report.rms_displacement = std::sqrt(squares / static_cast<double>(report.vertices));
    if (selection.empty() && report.boundary_edges == 0 && report.oriented_consistently)
        report.volume_before = enclosed_volume(before);
    report.volume_change =
        parallel_sum(static_cast<std::int64_t>(before.triangles.size()), 0.0,
                     [&](std::int64_t begin, std::int64_t end) {
                         double sum = 0;
                         for (std::int64_t i = begin; i < end; ++i) {
                             if (!selection.empty() && selection[i] == 0) continue;
                             const Triangle& triangle = before.triangles[i];
                             sum += swept_volume(corners_of(before.positions, triangle),
                                                 corners_of(after, triangle));
                         }
                         return sum;
                     });
}

/// Returns what FlowReport::quality holds after the surface has moved from `before` to `after`.
std::vector<double> measure_quality(Quality quality, Flow& flow, const TriangleMesh& before,
                                    const std::vector<Eigen::Vector3d>& after,
                                    const Selection& selection) {
    if (quality == Quality::None) return {};
    std::vector<Eigen::Vector3d> vectors(after.size(), Eigen::Vector3d::Zero());
    if (quality == Quality::MeanCurvature) {
        vectors = flow.velocities(after.size());
        for (Eigen::Vector3d& velocity : vectors) velocity *= -0.5;
    } else {
        for (std::size_t i = 0; i < after.size(); ++i) vectors[i] = after[i] - before.positions[i];
    }
    return along_normals(vectors, {after, before.triangles}, selection);
}

/// Returns whether a mean-curvature flow has made the area grow, which the exact one does not. The
/// tolerance is relative to the displacement of the whole surface, so the grid may displace parts
/// that are much thinner than its cells by more than their width.
bool area_has_grown(const FlowParameters& parameters, double before, double after) {
    const bool may_grow = parameters.flow != FlowKind::MeanCurvature || parameters.order > 1 ||
                          parameters.preserve != Preserve::None;
    return !may_grow && after > (1 + kGrowth) * before;
}

/// Adds the time and the iterations of the steps of a flow that was made again.
void add_effort(const std::vector<StepReport>& discarded, std::vector<StepReport>& steps) {
    for (std::size_t i = 0; i < discarded.size() && !steps.empty(); ++i) {
        StepReport& step = steps[std::min(i, steps.size() - 1)];
        step.assemble_seconds += discarded[i].assemble_seconds;
        step.solve_seconds += discarded[i].solve_seconds;
        step.solver_iterations += discarded[i].solver_iterations;
    }
}

}  // namespace

double default_detail_size(const TriangleMesh& mesh, const Selection& selection) {
    return kDefaultDetailInEdges * mean_edge_length(mesh, selection);
}

FlowReport evolve(TriangleMesh& mesh, const Inputs& inputs, const FlowParameters& parameters,
                  const Progress& progress, const StepObserver& on_step) {
    std::optional<ProgressMeter> meter;
    if (progress) meter.emplace(progress);
    validate(parameters);
    const ThreadTeam team(parameters.threads);
    const std::int64_t memory_before = resident_memory_bytes();
    const Stopwatch setup;
    enter_setup_phase(kCheckMesh);
    validate(mesh, inputs);
    Selection moving;
    Flow flow = set_up(mesh, inputs, parameters, moving);
    const double setup_seconds = setup.seconds();

    const double area_before = surface_area(mesh, moving);
    const Task task{mesh, moving, parameters, on_step};
    Moved after = flow_through(flow, task, area_before);
    std::vector<StepReport> discarded;
    if (parameters.tolerance > kCarefulTolerance &&
        area_has_grown(parameters, area_before, after.area)) {
        discarded = flow.report().steps;
        flow.restart_with_care();
        after = flow_through(flow, task, area_before, ", again with more care");
    }

    enter_phase(progress_before(parameters.iterations, parameters.iterations),
                "Moving the vertices");
    FlowReport report = flow.report();
    add_effort(discarded, report.steps);
    report.setup_seconds = setup_seconds;
    report.area_before = area_before;
    report.area_after = after.area;
    compare(mesh, after.positions, moving, report);
    report.quality = measure_quality(parameters.quality, flow, mesh, after.positions, moving);
    report.estimated_memory_bytes += memory_before;
    report.peak_memory_bytes = peak_memory_bytes();
    enter_phase(1, "Done");
    // Nothing can fail from here on.
    mesh.positions.swap(after.positions);
    return report;
}

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    return evolve(mesh, {}, parameters, progress);
}

}  // namespace tracked_mcf
