// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>

#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/setup_times.h"
#include "tests/research/benchmark/sphere_error.h"
#include "tests/research/benchmark/subcommands.h"
#include "tests/research/benchmark/tracked_options.h"
#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::benchmark {

namespace {

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
    print_quantity("depth", 0, report.depth);
    print_quantity("unknowns", 0, report.unknowns);
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

/// Measures the assembly of the octree's element matrices alone.
void print_assembly(const PaperFlow& flow, double step_size) {
    const TrackedElements& elements = flow.elements();
    print_quantity("samples", 0, elements.samples.size());
    const double cell = elements.grid.cell_size;
    ElementSystems systems;
    for (int repetition = 0; repetition < 4; ++repetition) {
        const ProcessStopwatch stopwatch;
        assemble_elements(elements, flow.displacement(), step_size / (cell * cell), false, systems);
        // The first repetition also allocates memory.
        if (repetition > 0) print_seconds("kernel", repetition, stopwatch.seconds());
    }
}

void run(const TrackedOptions& options) {
    const FlowParameters parameters = options.parameters();
    const ThreadTeam threads(options.threads);
    TriangleMesh mesh = named_mesh(options.mesh);
    print_header();
    print_quantity("mesh_memory_bytes", 0, peak_memory_bytes());
    const std::unique_ptr<SurfaceFlow> flow = set_up(mesh, parameters);
    print_quantity("setup_memory_bytes", 0, peak_memory_bytes());
    print_sizes(flow->report());
    for (int number = 1; number <= options.steps; ++number) {
        if (!step(*flow, number)) break;
    }
    const ProcessStopwatch stopwatch;
    flow->move_vertices(mesh.positions);
    print_seconds("move", 0, stopwatch.seconds());
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, mesh.positions, options.step_size, options.steps);
    if (const auto* paper = dynamic_cast<const PaperFlow*>(flow.get()))
        print_assembly(*paper, options.step_size);
}

}  // namespace

void add_flow(CLI::App& app) {
    const auto options = std::make_shared<TrackedOptions>();
    CLI::App* command =
        app.add_subcommand("flow", "Measures our flow: the set-up by phase, then the steps.");
    add_options(*command, *options);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
