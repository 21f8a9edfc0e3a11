// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/options.h"
#include "tests/experiments/reference.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct SphereOptions : Options {
    int frequency = 128;
    bool cotangent = false;
};

/// r(t + δ) = r³ / (r² + 2δ)
double exact_radius(const SphereOptions& options) {
    double r = 1;
    for (int step = 0; step < options.last_step(); ++step)
        r = r * r * r / (r * r + 2 * options.step_size());
    return r;
}

struct RadiusError {
    double mean = 0;   ///< of the mean radius, signed
    double worst = 0;  ///< of a vertex
};

RadiusError radius_error(const TriangleMesh& mesh, const SphereOptions& options) {
    const double exact = exact_radius(options);
    RadiusError error;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const double difference = position.norm() - exact;
        error.mean += difference / static_cast<double>(mesh.positions.size());
        error.worst = std::max(error.worst, std::abs(difference));
    }
    return error;
}

void measure(TriangleMesh mesh, const SphereOptions& options, int depth,
             const std::string& configuration) {
    FlowParameters parameters = options.parameters(depth, configuration);
    parameters.step_size /= 4;  // the longest side is 2
    parameters.iterations = options.last_step();
    const FlowReport report = evolve(mesh, parameters);
    const RadiusError error = radius_error(mesh, options);
    int iterations = 0;
    for (const StepReport& step : report.steps) iterations += step.solver_iterations;
    print_row(depth, configuration, report.cell_size, error.mean, error.worst, iterations);
}

/// Measures the error of the mesh alone, without a grid.
void measure_cotangent_flow(const TriangleMesh& mesh, const SphereOptions& options) {
    const auto references = cotangent_flow(mesh, options.step_size() / 4, options.steps);
    const RadiusError error = radius_error(references.at(options.last_step()).mesh, options);
    print_row(0, "cotangent", 0, error.mean, error.worst, 0);
}

void run(const SphereOptions& options) {
    print_row("depth", "configuration", "cell_size", "mean_error", "worst_vertex", "iterations");
    const TriangleMesh mesh = shapes::geodesic_sphere(options.frequency);
    if (options.cotangent) return measure_cotangent_flow(mesh, options);
    options.for_each_case([&](int depth, const std::string& configuration) {
        measure(mesh, options, depth, configuration);
    });
}

}  // namespace

void add_sphere(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "sphere",
        "Flows the unit sphere with absolute steps. Prints the signed error of the mean radius and "
        "the largest error of a vertex, against the exact semi-implicit radius.",
        run, with_defaults<SphereOptions>({100}, 1e-3));
    command->add_option("--frequency", options->frequency);
    command->add_flag("--cotangent", options->cotangent, "measure the cotangent flow instead");
}

}  // namespace tracked_mcf::experiments
