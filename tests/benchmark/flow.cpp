// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"
#include "tests/benchmark/meshes.h"
#include "tests/benchmark/rows.h"
#include "tests/benchmark/setup_times.h"
#include "tests/benchmark/sphere_error.h"
#include "tests/benchmark/subcommands.h"
#include "tests/benchmark/tracked_options.h"
#include "tests/support/plans.h"

namespace tracked_mcf::benchmark {

namespace {

/// Sets a flow up as evolve() does and prints the time of each phase.
void set_up(const TriangleMesh& mesh, const FlowParameters& parameters, std::optional<Flow>& flow) {
    SetupTimes times;
    const Progress progress = times.progress();
    const ProgressMeter meter(progress);
    const ProcessStopwatch stopwatch;
    enter_setup_phase(kCheckMesh);
    validate(mesh);
    flow.emplace(plan_of(mesh, parameters));
    print_seconds("setup", 0, stopwatch.seconds());
    for (const auto& [phase, seconds] : times.finish())
        print_seconds("setup: " + phase, 0, seconds);
}

void print_sizes(const FlowReport& report) {
    print_quantity("vertices", 0, report.vertices);
    print_quantity("triangles", 0, report.triangles);
    print_quantity("depth", 0, report.depth);
    print_quantity("cells", 0, report.cells);
    print_quantity("elements", 0, report.elements);
    print_quantity("unknowns", 0, report.unknowns);
    print_quantity("fragments", 0, report.fragments);
    print_quantity("samples", 0, report.samples);
}

/// Prints the memory of the structures that a step reads and writes.
void print_bytes(const Flow& flow) {
    const TrackedElements& elements = flow.stepper().elements();
    const auto bytes_of = [](const auto& values) { return values.size() * sizeof(values[0]); };
    const auto element_count = static_cast<std::size_t>(elements.finest().element_count());
    print_quantity("sample_bytes", 0, Samples::kBytesPerSample * elements.samples.size());
    print_quantity("fragment_bytes", 0, bytes_of(elements.fragments));
    print_quantity("element_system_bytes", 0,
                   element_count * (sizeof(MatrixBlock) / kBlockElements + sizeof(ElementVector)));
    const auto unknown_count = static_cast<std::size_t>(flow.state().displacement.rows());
    print_quantity("coefficient_bytes", 0, 3 * sizeof(double) * unknown_count);
    // A product with the finest level's matrix, or the smoother's, reads the elements' matrices and
    // unknowns, reads one vector, and reads and writes another.
    print_quantity(
        "product_bytes", 0,
        element_count * (sizeof(MatrixBlock) / kBlockElements + 8 * sizeof(std::int32_t)) +
            unknown_count * 3 * 4 * sizeof(float));
    print_quantity("step_size_in_cells", 0, flow.stepper().size().in_cells);
}

bool step(Flow& flow, int number) {
    const ProcessStopwatch stopwatch;
    if (!flow.step()) return false;
    print_seconds("step", number, stopwatch.seconds());
    const StepReport& report = flow.report().steps.back();
    print_quantity("assemble_seconds", number, report.assemble_seconds);
    print_quantity("solve_seconds", number, report.solve_seconds);
    print_quantity("iterations", number, report.solver_iterations);
    print_quantity("error_estimate", number, report.error_estimate);
    return true;
}

/// Measures the assembly of the elements' matrices alone.
void print_assembly(const Flow& flow) {
    ElementSystems systems;
    for (int repetition = 0; repetition < 4; ++repetition) {
        const ProcessStopwatch stopwatch;
        assemble_elements(flow.stepper().elements(), flow.state().displacement,
                          {1.0F, static_cast<float>(flow.stepper().size().in_cells)}, systems);
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
    std::optional<Flow> flow;
    set_up(mesh, parameters, flow);
    print_quantity("setup_memory_bytes", 0, peak_memory_bytes());
    print_sizes(flow->report());
    print_bytes(*flow);
    for (int number = 1; number <= options.steps; ++number) {
        if (!step(*flow, number)) break;
    }
    const ProcessStopwatch stopwatch;
    flow->move_vertices(mesh.positions);
    print_seconds("move", 0, stopwatch.seconds());
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, mesh.positions, options.step_size, options.steps);
    print_assembly(*flow);
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
