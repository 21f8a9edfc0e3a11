#include "filter_tracked_mcf/core/evolve.h"

#include <optional>
#include <string>

#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/peak_memory.h"
#include "filter_tracked_mcf/core/progress_meter.h"
#include "filter_tracked_mcf/core/rescaling.h"
#include "filter_tracked_mcf/core/setup_phases.h"
#include "filter_tracked_mcf/core/stopwatch.h"

namespace tracked_mcf {

namespace {

/// Setting up takes about as long as this many steps.
constexpr double kSetupInSteps = 5;

/// Moving the vertices takes about as long as this part of a step.
constexpr double kFinishInSteps = 0.03;

/// How the work is shared out.
struct Shares {
    explicit Shares(int iterations) : total(kSetupInSteps + iterations + kFinishInSteps) {}

    /// Where this step, from 0, begins and the one before, or the set-up, ends.
    double step_begin(int step) const { return (kSetupInSteps + step) / total; }

    double total;
};

/// A flow, and what rescales it if so asked.
struct Run {
    std::optional<Rescaler> rescaler;
    std::optional<Flow> flow;
};

void set_up(const TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
            Run& run) {
    enter_setup_phase(SetupPhase::CheckMesh);
    validate(mesh);
    if (parameters.rescale != Rescaling::None) {
        enter_setup_phase(SetupPhase::MeasureSurface);
        run.rescaler.emplace(mesh, selection, parameters);
    }
    run.flow.emplace(mesh, parameters, selection);
}

/// Makes the steps, until the last or until there is nothing left to do.
void make_steps(Run& run, int iterations, const Shares& shares) {
    for (int step = 0; step < iterations; ++step) {
        const ProgressSpan span(shares.step_begin(step), shares.step_begin(step + 1));
        enter_phase(0, "Step " + std::to_string(step + 1) + " of " + std::to_string(iterations));
        if (!run.flow->step()) return;
        if (run.rescaler && !run.rescaler->restore(*run.flow)) return;
    }
}

/// A copy of the mesh where the flow has led, or where it was before the last step if the surface
/// has vanished in that one, which the flow itself would notice in the next.
TriangleMesh moved(const TriangleMesh& mesh, const Selection& selection, Flow& flow,
                   double area_before) {
    TriangleMesh result{copy_of(mesh.positions), copy_of(mesh.triangles)};
    flow.move_vertices(result);
    if (flow.report().stop == Stop::None &&
        surface_area(result, selection) <= kVanishedArea * area_before) {
        flow.take_back(Stop::Vanished);
        result.positions = copy_of(mesh.positions);
        flow.move_vertices(result);
    }
    return result;
}

}  // namespace

FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  ProgressMeter& meter) {
    validate(parameters);
    const ThreadCountScope threads(parameters.threads);
    const Shares shares(parameters.iterations);
    Run run;

    const Stopwatch setup;
    {
        const ProgressSpan span(0, shares.step_begin(0));
        set_up(mesh, selection, parameters, run);
    }
    const double setup_seconds = setup.seconds();
    make_steps(run, parameters.iterations, shares);

    enter_phase(shares.step_begin(parameters.iterations), "Moving the vertices");
    const double area_before = surface_area(mesh, selection);
    TriangleMesh result = moved(mesh, selection, *run.flow, area_before);
    FlowReport report = run.flow->report();
    report.setup_seconds = setup_seconds;
    report.area_before = area_before;
    report.area_after = surface_area(result, selection);
    report.peak_memory_bytes = peak_memory_bytes();
    meter.done();
    // Nothing from here on can fail.
    mesh.positions.swap(result.positions);
    return report;
}

FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  const Progress& progress) {
    ProgressMeter meter(progress);
    return evolve(mesh, selection, parameters, meter);
}

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    return evolve(mesh, {}, parameters, progress);
}

}  // namespace tracked_mcf
