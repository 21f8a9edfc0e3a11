#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/reference.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    int frequency = 128;
    int steps = 100;
    double step_size = 1e-3;  ///< absolute
    bool cotangent = false;
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

struct RadiusError {
    double mean = 0;   ///< of the mean radius, signed
    double worst = 0;  ///< of a vertex
};

RadiusError radius_error(const TriangleMesh& mesh, const Options& options) {
    const double exact = exact_radius(options);
    RadiusError error;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const double difference = position.norm() - exact;
        error.mean += difference / static_cast<double>(mesh.positions.size());
        error.worst = std::max(error.worst, std::abs(difference));
    }
    return error;
}

void measure(TriangleMesh mesh, const Options& options, int depth,
             const std::string& configuration) {
    FlowParameters parameters = parse_configuration(configuration);
    parameters.depth = depth;
    parameters.step_size = options.step_size / 4;  // the longest side is 2
    parameters.iterations = options.steps;
    const FlowReport report = evolve(mesh, parameters);
    const RadiusError error = radius_error(mesh, options);
    int iterations = 0;
    for (const StepReport& step : report.steps) iterations += step.solver_iterations;
    print_row(depth, configuration, report.cell_size, error.mean, error.worst, iterations);
}

/// What the mesh alone, without a grid, is off by.
void measure_cotangent_flow(const TriangleMesh& mesh, const Options& options) {
    const auto references = cotangent_flow(mesh, options.step_size / 4, {options.steps});
    const RadiusError error = radius_error(references.at(options.steps).mesh, options);
    print_row(0, "cotangent", 0, error.mean, error.worst, 0);
}

void run(const Options& options) {
    print_row("depth", "configuration", "cell_size", "mean_error", "worst_vertex", "iterations");
    const TriangleMesh mesh = shapes::geodesic_sphere(options.frequency);
    if (options.cotangent) measure_cotangent_flow(mesh, options);
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
    command->add_flag("--cotangent", options->cotangent, "measure the cotangent flow too");
    command->add_option("--depths", options->depths);
    command->add_option("--configurations", options->configurations);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
