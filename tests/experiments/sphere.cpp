#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    int frequency = 128;
    int steps = 100;
    double step_size = 1e-3;  ///< absolute
    std::vector<int> depths;
    std::vector<std::string> configurations;
};

/// r(t + δ) = r³ / (r² + 2δ)
double exact_radius(const Options& options) {
    double r = 1;
    for (int step = 0; step < options.steps; ++step)
        r = r * r * r / (r * r + 2 * options.step_size);
    return r;
}

void measure(TriangleMesh mesh, const Options& options, int depth,
             const std::string& configuration) {
    FlowParameters parameters = parse_configuration(configuration);
    parameters.depth = depth;
    parameters.step_size = options.step_size / 4;  // the longest side is 2
    parameters.iterations = options.steps;
    const FlowReport report = evolve(mesh, parameters);
    const double exact = exact_radius(options);
    double sum = 0;
    double worst = 0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        sum += position.norm() - exact;
        worst = std::max(worst, std::abs(position.norm() - exact));
    }
    int iterations = 0;
    for (const StepReport& step : report.steps) iterations += step.solver_iterations;
    print_row(depth, configuration, report.cell_size,
              sum / static_cast<double>(mesh.positions.size()), worst, iterations);
}

void run(const Options& options) {
    print_row("depth", "configuration", "cell_size", "mean_error", "worst_vertex", "iterations");
    const TriangleMesh mesh = shapes::geodesic_sphere(options.frequency);
    for (const int depth : options.depths) {
        for (const std::string& configuration : options.configurations) {
            measure(mesh, options, depth, configuration);
        }
    }
}

}  // namespace

void add_sphere(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "sphere",
        "The unit sphere against its exact semi-implicit radius: signed error of the mean radius, "
        "and the worst vertex's.");
    command->add_option("--frequency", options->frequency);
    command->add_option("--steps", options->steps);
    command->add_option("--step-size", options->step_size, "absolute");
    command->add_option("--depths", options->depths)->required();
    command->add_option("--configurations", options->configurations)->required();
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
