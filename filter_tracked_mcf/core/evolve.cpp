#include "filter_tracked_mcf/core/evolve.h"

#include <string>

#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/peak_memory.h"
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

}  // namespace

FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters, const Progress& progress) {
    validate(parameters);
    validate(mesh);
    const ThreadCountScope threads(parameters.threads);
    const ProgressMeter meter(progress, parameters.iterations);

    meter.begin_setup();
    const Stopwatch setup;
    Flow flow(mesh, parameters);
    const double setup_seconds = setup.seconds();
    for (int step = 0; step < parameters.iterations; ++step) {
        meter.begin_step(step, parameters.iterations);
        flow.step();
    }
    meter.done();

    FlowReport report = flow.report();
    report.setup_seconds = setup_seconds;
    report.area_before = surface_area(mesh);
    flow.move_vertices(mesh);
    report.area_after = surface_area(mesh);
    report.peak_memory_bytes = peak_memory_bytes();
    return report;
}

}  // namespace tracked_mcf
