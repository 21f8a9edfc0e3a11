#include "filter_tracked_mcf/core/evolve.h"

#include <optional>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/peak_memory.h"
#include "filter_tracked_mcf/core/rescaling.h"
#include "filter_tracked_mcf/core/stopwatch.h"

namespace tracked_mcf {

namespace {

/// Setting up takes about as long as this many steps, which is what progress is measured in.
constexpr double kSetupInSteps = 4;

/// Tells the caller how far the work has come.
class ProgressMeter {
public:
    ProgressMeter(const Progress& progress, int iterations)
        : progress_(progress), total_(kSetupInSteps + iterations) {}

    void begin_setup() const { tell(0, "Building the octree"); }
    void begin_step(int step, int iterations) const {
        tell((kSetupInSteps + step) / total_,
             "Step " + std::to_string(step + 1) + " of " + std::to_string(iterations));
    }
    void done() const { tell(1, "Done"); }

private:
    void tell(double fraction, const std::string& phase) const {
        if (progress_ && !progress_(fraction, phase)) throw Cancelled("Stopped as asked.");
    }

    const Progress& progress_;
    double total_;
};

/// Makes the steps, until the last or until there is nothing left to do.
void run(Flow& flow, std::optional<Rescaler>& rescaler, int iterations,
         const ProgressMeter& meter) {
    for (int step = 0; step < iterations; ++step) {
        meter.begin_step(step, iterations);
        if (!flow.step()) return;
        if (rescaler && !rescaler->restore(flow)) return;
    }
}

/// Brings the mesh to where the flow has led, or to where it was before the last step if the
/// surface has vanished in that one, which the flow itself would notice in the next.
void finish(Flow& flow, TriangleMesh& mesh, const Selection& selection) {
    const std::vector<Eigen::Vector3d> start = mesh.positions;
    const double area = surface_area(mesh, selection);
    flow.move_vertices(mesh);
    if (flow.report().stop == Stop::None && surface_area(mesh, selection) <= kVanishedArea * area) {
        flow.take_back(Stop::Vanished);
        mesh.positions = start;
        flow.move_vertices(mesh);
    }
}

}  // namespace

FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  const Progress& progress) {
    validate(parameters);
    validate(mesh);
    const ThreadCountScope threads(parameters.threads);
    const ProgressMeter meter(progress, parameters.iterations);

    meter.begin_setup();
    const Stopwatch setup;
    std::optional<Rescaler> rescaler;
    if (parameters.rescale != Rescaling::None) rescaler.emplace(mesh, selection, parameters);
    Flow flow(mesh, parameters, selection);
    const double setup_seconds = setup.seconds();
    run(flow, rescaler, parameters.iterations, meter);
    meter.done();

    const double area_before = surface_area(mesh, selection);
    finish(flow, mesh, selection);
    FlowReport report = flow.report();
    report.setup_seconds = setup_seconds;
    report.area_before = area_before;
    report.area_after = surface_area(mesh, selection);
    report.peak_memory_bytes = peak_memory_bytes();
    return report;
}

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    return evolve(mesh, {}, parameters, progress);
}

}  // namespace tracked_mcf
