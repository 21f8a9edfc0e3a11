// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "filter_tracked_mcf/core/progress.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"
#include "tests/research/benchmark/subcommands.h"
#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::benchmark {

namespace {

struct Options {
    std::string mesh;
    std::string configuration = "converged";
    double step_size = 5e-4;
    int depth = 0;
    int steps = 4;
    int threads = 1;

    /// Returns the parameters for a mesh in the unit cube, with δ in its squared units.
    FlowParameters parameters() const {
        FlowParameters parameters = experiments::parse_configuration(configuration);
        parameters.step_size = step_size;
        parameters.depth = depth;
        parameters.iterations = steps;
        parameters.threads = threads;
        return parameters;
    }
};

/// Measures the phases of a set-up by the names that the progress callback receives.
class SetupTimes {
public:
    /// Returns the callback for a ProgressMeter, which calls it several times in each phase. This
    /// object must outlive the meter.
    Progress progress() {
        return [this](double, std::string_view phase) {
            if (phase != phase_) enter(phase);
            return true;
        };
    }

    /// Ends the last phase. Returns all phases with their times, in order.
    const std::vector<std::pair<std::string, Seconds>>& finish() {
        enter("");
        return times_;
    }

private:
    void enter(std::string_view phase) {
        if (!phase_.empty()) times_.emplace_back(phase_, since_entered_.seconds());
        phase_ = phase;
        since_entered_ = ProcessStopwatch();
    }

    std::string phase_;
    ProcessStopwatch since_entered_;
    std::vector<std::pair<std::string, Seconds>> times_;
};

/// Sets a flow up as evolve() does and prints the time of each phase.
std::unique_ptr<SurfaceFlow> set_up(const TriangleMesh& mesh, const FlowParameters& parameters) {
    SetupTimes times;
    const Progress progress = times.progress();
    const ProgressMeter meter(progress);
    const ProcessStopwatch stopwatch;
    enter_setup_phase(kCheckMesh);
    validate(mesh);
    std::unique_ptr<SurfaceFlow> flow = experiments::make_flow(mesh, parameters);
    print_seconds("setup", 0, stopwatch.seconds());
    for (const auto& [phase, seconds] : times.finish())
        print_seconds("setup: " + phase, 0, seconds);
    return flow;
}

void print_sizes(const FlowReport& report) {
    print_quantity("vertices", 0, report.vertices);
    print_quantity("triangles", 0, report.triangles);
}

bool step(SurfaceFlow& flow, int number) {
    const ProcessStopwatch stopwatch;
    if (!flow.step()) return false;
    print_seconds("step", number, stopwatch.seconds());
    const StepReport& report = flow.report().steps.back();
    print_quantity("assemble_seconds", number, report.assemble_seconds);
    print_quantity("solve_seconds", number, report.solve_seconds);
    print_quantity("iterations", number, report.solver_iterations);
    return true;
}

void run(const Options& options) {
    const FlowParameters parameters = options.parameters();
    const ThreadTeam threads(options.threads);
    TriangleMesh mesh = named_mesh(options.mesh);
    print_header();
    const std::unique_ptr<SurfaceFlow> flow = set_up(mesh, parameters);
    print_sizes(flow->report());
    for (int number = 1; number <= options.steps; ++number) {
        if (!step(*flow, number)) break;
    }
    flow->move_vertices(mesh.positions);
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, mesh.positions, options.step_size, options.steps);
}

}  // namespace

void add_flow(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("flow", "Measures our flow: the set-up by phase, then the steps.");
    command->add_option("mesh", options->mesh, "see tests/research/benchmark/meshes.h")->required();
    command->add_option("--solver", options->configuration,
                        "see tests/research/experiments/configuration.h");
    command->add_option("--step-size", options->step_size);
    command->add_option("--depth", options->depth, "0: automatic");
    command->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
    command->add_option("--threads", options->threads)->check(CLI::PositiveNumber);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
