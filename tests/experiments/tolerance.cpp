#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/support/cotangent_flow.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    std::vector<int> depths;
    std::vector<double> step_sizes;
    std::vector<double> tolerances;
    double tightest = 1e-9;
    int steps = 1;
    std::string configuration = "converged";
};

struct Solution {
    TriangleMesh mesh;
    int iterations = 0;  ///< over all steps
    bool reached_tolerance = true;
};

Solution solve(const TriangleMesh& mesh, FlowParameters parameters, double tolerance, int steps) {
    parameters.tolerance = tolerance;
    Solution solution;
    Flow flow(mesh, parameters);
    for (int step = 0; step < steps; ++step) flow.step();
    for (const StepReport& step : flow.report().steps) {
        solution.iterations += step.solver_iterations;
        solution.reached_tolerance &= step.reached_tolerance;
    }
    solution.mesh = mesh;
    flow.move_vertices(solution.mesh);
    return solution;
}

TriangleMesh cotangent_flow(const TriangleMesh& mesh, double step_size, int steps) {
    CotangentFlow flow(mesh, step_size, BoundaryCondition::Free);
    for (int step = 0; step < steps; ++step) flow.step();
    return flow.mesh();
}

/// Both distances are along the cotangent flow's normal, in diagonals.
void measure(const TriangleMesh& mesh, const TriangleMesh& reference, const Options& options,
             const FlowParameters& parameters) {
    const double unit = diagonal(mesh);
    const Solution best = solve(mesh, parameters, options.tightest, options.steps);
    const double discretisation = normal_distance(best.mesh, reference).rms / unit;
    for (const double tolerance : options.tolerances) {
        const Solution solution = solve(mesh, parameters, tolerance, options.steps);
        // The reference's vertices, moved by the solver's error.
        TriangleMesh off = reference;
        for (std::size_t i = 0; i < off.positions.size(); ++i) {
            off.positions[i] += solution.mesh.positions[i] - best.mesh.positions[i];
        }
        const NormalDistance error = normal_distance(off, reference);
        print_row(parameters.depth, parameters.step_size, tolerance, solution.iterations,
                  solution.reached_tolerance ? 1 : 0, error.rms / unit, error.worst / unit,
                  discretisation, best.reached_tolerance ? 1 : 0);
    }
}

void run(const Options& options) {
    print_row("depth", "step_size", "tolerance", "iterations", "reached_tolerance", "solver_rms",
              "solver_worst", "discretisation_rms", "tightest_reached");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const double step_size : options.step_sizes) {
        const TriangleMesh reference = cotangent_flow(mesh, step_size, options.steps);
        for (const int depth : options.depths) {
            FlowParameters parameters = parse_configuration(options.configuration);
            parameters.depth = depth;
            parameters.step_size = step_size;
            parameters.boundary = BoundaryCondition::Free;
            measure(mesh, reference, options, parameters);
        }
    }
}

}  // namespace

void add_tolerance(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "tolerance",
        "The solver's error (distance to the solution at the tightest tolerance) beside the "
        "discretisation's (that solution's distance to the cotangent flow): root mean squares "
        "along the normal, in diagonals of the initial bounding box. Boundaries are free.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--depths", options->depths)->required();
    command->add_option("--step-sizes", options->step_sizes)->required();
    command->add_option("--tolerances", options->tolerances)->required();
    command->add_option("--tightest", options->tightest);
    command->add_option("--steps", options->steps);
    command->add_option("--configuration", options->configuration);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
