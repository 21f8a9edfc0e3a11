// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "filter_tracked_mcf/core/parallel/thread_team.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/incomplete_cholesky_flow.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"
#include "tests/research/benchmark/subcommands.h"

namespace tracked_mcf::benchmark {

namespace {

struct Options {
    std::string mesh;
    std::string order = "rcm";
    int steps = 4;
    bool cold = false;
    IncompleteCholeskyParameters flow;
};

void step(IncompleteCholeskyFlow& flow, int number) {
    const ProcessStopwatch stopwatch;
    const IncompleteCholeskyReport report = flow.step();
    print_seconds("step", number, stopwatch.seconds());
    print_quantity("assemble_seconds", number, report.assemble_seconds);
    print_quantity("factorize_seconds", number, report.factorize_seconds);
    print_quantity("solve_seconds", number, report.solve_seconds);
    print_quantity("iterations", number, report.iterations);
    print_quantity("relative_residual", number, report.relative_residual);
}

void run(const Options& options) {
    IncompleteCholeskyParameters parameters = options.flow;
    parameters.order = parse_vertex_order(options.order);
    parameters.warm_start = !options.cold;
    const TriangleMesh mesh = named_mesh(options.mesh);
    const ThreadTeam team(parameters.threads);
    print_header();
    print_quantity("mesh_memory_bytes", 0, peak_memory_bytes());
    const ProcessStopwatch stopwatch;
    IncompleteCholeskyFlow flow(mesh, parameters);
    print_seconds("setup", 0, stopwatch.seconds());
    print_quantity("vertices", 0, flow.pattern().vertex_count);
    print_quantity("unknowns", 0, flow.pattern().unknown_count);
    print_quantity("bytes", 0, flow.bytes());
    for (int number = 1; number <= options.steps; ++number) step(flow, number);
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, flow.positions(), parameters.step_size, options.steps);
}

}  // namespace

void add_baseline(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "baseline",
        "Measures the cotangent flow by conjugate gradients with an incomplete Cholesky "
        "factorisation.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--step-size", options->flow.step_size);
    command->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
    command->add_option("--threads", options->flow.threads)->check(CLI::PositiveNumber);
    command->add_option("--tolerance", options->flow.tolerance);
    command->add_option("--order", options->order, "order of the vertices: given, rcm or morton");
    command->add_option("--relaxation", options->flow.relaxation,
                        "fraction of the omitted fill that is added to the diagonal");
    command->add_option("--most-iterations", options->flow.most_iterations);
    command->add_flag("--cold", options->cold,
                      "start from a displacement of 0, not from the last step's");
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
