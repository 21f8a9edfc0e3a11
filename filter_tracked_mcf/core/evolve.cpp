// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/evolve.h"

#include <memory>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/flow/stepping/mesh_flow.h"
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"
#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

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
    throw InvalidParameter(
        "method",
        "is Paper, which smooths all faces in the same way, without a selection or a "
        "strength of vertices; take the method Converged.");
}

std::unique_ptr<SurfaceFlow> set_up(const TriangleMesh& mesh, const Inputs& inputs,
                                    const FlowParameters& parameters) {
    const ProgressSpan span(0, progress_before(0, parameters.iterations));
    if (parameters.method == Method::Paper)
        return std::make_unique<PaperFlow>(paper_plan_of(mesh, parameters));
    return std::make_unique<MeshFlow>(mesh_plan_of(mesh, inputs, parameters));
}

/// Returns the positions to which a flow has moved the mesh.
std::vector<Eigen::Vector3d> moved_by(const SurfaceFlow& flow, const TriangleMesh& mesh) {
    std::vector<Eigen::Vector3d> positions = mesh.positions;
    flow.move_vertices(positions);
    return positions;
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
        // What the observer calls does not report to this flow's callback.
        const Progress nobody;
        const ProgressMeter silent(nobody);
        on_step(step + 1, moved_by(flow, mesh));
    }
}

}  // namespace

double default_detail_size(const TriangleMesh& mesh, const Selection& selection) {
    validate(mesh, Inputs{selection, {}});
    return kDefaultDetailInEdges * mean_edge_length(mesh, selection);
}

FlowReport evolve(TriangleMesh& mesh, const Inputs& inputs, const FlowParameters& parameters,
                  const Progress& progress, const StepObserver& on_step) {
    validate(parameters);
    if (parameters.method == Method::Paper) check_no_inputs(inputs);
    FilterRun run(parameters.threads, progress);
    const std::int64_t memory_before = resident_memory_bytes();
    const Stopwatch setup;
    enter_setup_phase(kCheckMesh);
    validate(mesh, inputs);
    const std::unique_ptr<SurfaceFlow> flow = set_up(mesh, inputs, parameters);
    const double setup_seconds = setup.seconds();

    make_steps(*flow, mesh, parameters.iterations, on_step);
    enter_phase(progress_before(parameters.iterations, parameters.iterations),
                "Moving the vertices");
    std::vector<Eigen::Vector3d> after = moved_by(*flow, mesh);
    FlowReport report = flow->report();
    report_change(mesh, after, flow->surface(), parameters.quality, report);
    if (report.stop == Stop::None && report.area_after <= kVanishedArea * report.area_before) {
        // The flow itself would notice only in the next step.
        flow->end_before_last_step(Stop::Vanished);
        after = moved_by(*flow, mesh);
        report = flow->report();
        report_change(mesh, after, flow->surface(), parameters.quality, report);
    }
    if (report.stop != Stop::None) {
        const auto steps = static_cast<int>(report.steps.size());
        report.detail_size =
            steps > 0 ? detail_size_for(report.step_size, steps, parameters.order) : 0;
    }
    report.setup_seconds = setup_seconds;
    if (parameters.quality == Quality::MeanCurvature) report.quality = flow->mean_curvatures(after);
    report.estimated_memory_bytes += memory_before;
    run.finish(mesh, std::move(after), report);
    return report;
}

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    return evolve(mesh, {}, parameters, progress);
}

}  // namespace tracked_mcf
