// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/evolve.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "filter_tracked_mcf/core/flow/mesh_flow.h"
#include "filter_tracked_mcf/core/flow/paper_flow.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
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

/// Throws InvalidParameter if there are inputs, which the paper's method does not have.
void check_no_inputs(const Inputs& inputs) {
    if (inputs.selection.empty() && inputs.strength.empty()) return;
    throw InvalidParameter("method",
                           "is Paper, which smooths all faces alike, without a selection or a "
                           "strength of vertices; take the method Converged.");
}

std::unique_ptr<SurfaceFlow> set_up(const TriangleMesh& mesh, const Inputs& inputs,
                                    const FlowParameters& parameters) {
    const ProgressSpan span(0, progress_before(0, parameters.iterations));
    if (parameters.method == Method::Paper)
        return std::make_unique<PaperFlow>(paper_plan_of(mesh, parameters));
    return std::make_unique<MeshFlow>(mesh_plan_of(mesh, inputs, parameters));
}

/// Positions to which a flow has moved the mesh, and the area of the triangles that flow.
struct Moved {
    std::vector<Eigen::Vector3d> positions;
    double area;
};

Moved moved_by(const SurfaceFlow& flow, const TriangleMesh& mesh) {
    Moved moved{mesh.positions, 0};
    flow.move_vertices(moved.positions);
    moved.area = surface_area({moved.positions, mesh.triangles}, flow.selection());
    return moved;
}

/// Makes all steps, or fewer if nothing is left to do.
void make_steps(SurfaceFlow& flow, const TriangleMesh& mesh, int iterations,
                const StepObserver& on_step) {
    for (int step = 0; step < iterations; ++step) {
        const ProgressSpan span(progress_before(step, iterations),
                                progress_before(step + 1, iterations));
        enter_phase(0, "Step " + std::to_string(step + 1) + " of " + std::to_string(iterations));
        if (!flow.step()) return;
        if (!on_step) continue;
        std::vector<Eigen::Vector3d> positions = mesh.positions;
        flow.move_vertices(positions);
        on_step(step + 1, positions);
    }
}

/// Sets the report's measures of the change from `before` to `after`. Coincident vertices count
/// once.
void compare(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
             const std::vector<std::uint8_t>& counted, const Selection& selection,
             FlowReport& report) {
    double largest = 0, squares = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (counted[i] == 0) continue;
        const double square = (after[i] - before.positions[i]).squaredNorm();
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
std::vector<double> measure_quality(Quality quality, SurfaceFlow& flow, const TriangleMesh& before,
                                    const std::vector<Eigen::Vector3d>& after,
                                    const Selection& selection) {
    if (quality == Quality::None) return {};
    if (quality == Quality::Displacement)
        return displacements_along_normals(before, after, selection);
    return flow.mean_curvatures({after, before.triangles});
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
    if (parameters.method == Method::Paper) check_no_inputs(inputs);
    const ThreadTeam team(parameters.threads);
    const std::int64_t memory_before = resident_memory_bytes();
    const Stopwatch setup;
    enter_setup_phase(kCheckMesh);
    validate(mesh, inputs);
    const std::unique_ptr<SurfaceFlow> flow_owner = set_up(mesh, inputs, parameters);
    SurfaceFlow& flow = *flow_owner;
    const Selection& moving = flow.selection();
    const double setup_seconds = setup.seconds();

    const double area_before = surface_area(mesh, moving);
    make_steps(flow, mesh, parameters.iterations, on_step);
    Moved after = moved_by(flow, mesh);
    if (flow.report().stop == Stop::None && after.area <= kVanishedArea * area_before) {
        // The flow itself would notice only in the next step.
        flow.end_before_last_step(Stop::Vanished);
        after = moved_by(flow, mesh);
    }

    enter_phase(progress_before(parameters.iterations, parameters.iterations),
                "Moving the vertices");
    FlowReport report = flow.report();
    report.setup_seconds = setup_seconds;
    report.area_before = area_before;
    report.area_after = after.area;
    compare(mesh, after.positions, flow.one_copies(), moving, report);
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
