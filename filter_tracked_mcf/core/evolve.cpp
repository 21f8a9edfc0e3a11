// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/evolve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/flow/preserving.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
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

/// A flow, and what preserves its area or volume if the parameters ask for it.
struct Run {
    std::optional<Flow> flow;
    std::optional<Preserver> preserver;
    bool oriented_consistently = true;
};

void set_up(const TriangleMesh& mesh, const Selection& selection, FlowParameters parameters,
            Run& run) {
    enter_setup_phase(kCheckMesh);
    validate(mesh);
    enter_setup_phase(kFindEdges);
    const Domain domain(mesh, selection, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    check_preservable(domain, parameters);
    run.oriented_consistently = is_oriented_consistently(domain.topology());
    if (domain.constrains_all_vertices()) {
        // Nothing can move. The cheapest set-up is enough to say so.
        parameters.depth = 1;
        parameters.separate_sheets = false;
    }
    run.flow.emplace(domain, parameters);
    if (parameters.preserve != Preserve::None) {
        run.preserver.emplace(domain, parameters, *run.flow);
    }
}

/// Makes all steps, or fewer if nothing is left to do.
void make_steps(Run& run, int iterations) {
    for (int step = 0; step < iterations; ++step) {
        const ProgressSpan span(progress_before(step, iterations),
                                progress_before(step + 1, iterations));
        enter_phase(0, "Step " + std::to_string(step + 1) + " of " + std::to_string(iterations));
        if (!run.flow->step()) return;
        if (run.preserver && !run.preserver->restore(*run.flow)) return;
    }
}

/// Returns the positions to which the flow has moved the mesh. If the last step has made the
/// surface vanish, which the flow itself would notice only in the next step, undoes that step.
std::vector<Eigen::Vector3d> moved_positions(const TriangleMesh& mesh, const Selection& selection,
                                             Flow& flow, double area_before) {
    std::vector<Eigen::Vector3d> positions = mesh.positions;
    flow.move_vertices(positions);
    if (flow.report().stop == Stop::None &&
        surface_area({positions, mesh.triangles}, selection) <= kVanishedArea * area_before) {
        flow.undo_step(Stop::Vanished);
        positions = mesh.positions;
        flow.move_vertices(positions);
    }
    return positions;
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
std::vector<double> measure_quality(Quality quality, const Flow& flow, const TriangleMesh& before,
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
bool area_has_grown(const FlowParameters& parameters, const FlowReport& report) {
    const bool may_grow = parameters.flow != FlowKind::MeanCurvature || parameters.order > 1 ||
                          parameters.preserve != Preserve::None;
    return !may_grow && report.area_after > (1 + kGrowth) * report.area_before;
}

/// Flows again from the start, to a smaller tolerance.
FlowReport evolve_carefully(TriangleMesh& mesh, const Selection& selection,
                            const FlowParameters& parameters, const Progress& progress) {
    FlowParameters careful = parameters;
    careful.tolerance = kCarefulTolerance;
    FlowReport report = evolve(mesh, selection, careful, progress);
    for (StepReport& step : report.steps) {
        step.reached_tolerance = step.error_estimate <= parameters.tolerance;
    }
    return report;
}

}  // namespace

double default_detail_size(const TriangleMesh& mesh, const Selection& selection) {
    return kDefaultDetailInEdges * mean_edge_length(mesh, selection);
}

FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  const Progress& progress) {
    std::optional<ProgressMeter> meter;
    if (progress) meter.emplace(progress);
    validate(parameters);
    const ThreadCountScope threads(parameters.threads);
    const std::int64_t memory_before = resident_memory_bytes();
    Run run;

    const Stopwatch setup;
    {
        const ProgressSpan span(0, progress_before(0, parameters.iterations));
        set_up(mesh, selection, parameters, run);
    }
    const double setup_seconds = setup.seconds();
    make_steps(run, parameters.iterations);

    enter_phase(progress_before(parameters.iterations, parameters.iterations),
                "Moving the vertices");
    const double area_before = surface_area(mesh, selection);
    auto positions = moved_positions(mesh, selection, *run.flow, area_before);
    FlowReport report = run.flow->report();
    report.setup_seconds = setup_seconds;
    report.area_before = area_before;
    report.area_after = surface_area({positions, mesh.triangles}, selection);
    if (parameters.tolerance > kCarefulTolerance && area_has_grown(parameters, report)) {
        run.flow.reset();
        return evolve_carefully(mesh, selection, parameters, progress);
    }
    report.oriented_consistently = run.oriented_consistently;
    compare(mesh, positions, selection, report);
    report.quality = measure_quality(parameters.quality, *run.flow, mesh, positions, selection);
    report.estimated_memory_bytes += memory_before;
    report.peak_memory_bytes = peak_memory_bytes();
    enter_phase(1, "Done");
    // Nothing can fail from here on.
    mesh.positions.swap(positions);
    return report;
}

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    return evolve(mesh, {}, parameters, progress);
}

}  // namespace tracked_mcf
