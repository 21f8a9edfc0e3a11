// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"
#include "tests/research/benchmark/subcommands.h"
#include "tests/research/benchmark/tracked_options.h"
#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::benchmark {

namespace {

void step(TriangleMesh& mesh, const FlowParameters& parameters, int number) {
    const ProcessStopwatch whole;
    const std::unique_ptr<SurfaceFlow> flow = experiments::make_flow(mesh, parameters);
    print_seconds("setup", number, whole.seconds());
    flow->step();
    const ProcessStopwatch moving;
    flow->move_vertices(mesh.positions);
    print_seconds("move", number, moving.seconds());
    print_seconds("step", number, whole.seconds());
    const StepReport& report = flow->report().steps.at(0);
    print_quantity("assemble_seconds", number, report.assemble_seconds);
    print_quantity("solve_seconds", number, report.solve_seconds);
    print_quantity("iterations", number, report.solver_iterations);
    print_quantity("unknowns", number, flow->report().unknowns);
}

void run(const TrackedOptions& options) {
    const ThreadTeam threads(options.threads);
    TriangleMesh mesh = named_mesh(options.mesh);
    print_header();
    for (int number = 1; number <= options.steps; ++number) {
        step(mesh, options.parameters(), number);
    }
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, mesh.positions, options.step_size, options.steps);
}

}  // namespace

void add_rebuilt(CLI::App& app) {
    const auto options = std::make_shared<TrackedOptions>();
    CLI::App* command = app.add_subcommand(
        "rebuilt",
        "Measures our flow without tracking: a new set-up from the evolved mesh before each step.");
    add_options(*command, *options);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
