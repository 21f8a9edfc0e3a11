#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    std::vector<int> depths;
    std::vector<double> step_sizes;
    std::vector<std::string> configurations;
};

void measure(const TriangleMesh& mesh, FlowParameters parameters,
             const std::string& configuration) {
    Flow flow(mesh, parameters);
    flow.step();
    const FlowReport& report = flow.report();
    const StepReport& step = report.steps.back();
    print_row(parameters.depth, parameters.step_size, configuration, report.unknowns,
              step.solver_iterations, step.relative_residual, step.reached_tolerance ? 1 : 0,
              step.residual_after / step.residual_before, step.solve_seconds);
}

void run(const Options& options) {
    print_row("depth", "step_size", "configuration", "unknowns", "iterations", "relative_residual",
              "reached_tolerance", "residual_ratio", "solve_seconds");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int depth : options.depths) {
        for (const double step_size : options.step_sizes) {
            for (const std::string& configuration : options.configurations) {
                FlowParameters parameters = parse_configuration(configuration);
                parameters.depth = depth;
                parameters.step_size = step_size;
                measure(mesh, parameters, configuration);
            }
        }
    }
}

}  // namespace

void add_iterations(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "iterations", "Iterations of the solver in the first step, and how far they came.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--depths", options->depths)->required();
    command->add_option("--step-sizes", options->step_sizes)->required();
    command->add_option("--configurations", options->configurations)->required();
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
