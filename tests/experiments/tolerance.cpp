#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/reference.h"
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

/// The reference's vertices, moved by a - b.
TriangleMesh moved_by_difference(TriangleMesh reference, const TriangleMesh& a,
                                 const TriangleMesh& b) {
    for (std::size_t i = 0; i < reference.positions.size(); ++i) {
        reference.positions[i] += a.positions[i] - b.positions[i];
    }
    return reference;
}

void measure(const TriangleMesh& mesh, const Reference& reference, const Options& options,
             const FlowParameters& parameters) {
    const double unit = diagonal(mesh);
    const auto rms = [&](const TriangleMesh& m) {
        return normal_distance(m, reference.mesh, reference.left_out).rms / unit;
    };
    const Solution best = solve(mesh, parameters, options.tightest, options.steps);
    for (const double tolerance : options.tolerances) {
        const Solution solution = solve(mesh, parameters, tolerance, options.steps);
        print_row(parameters.depth, parameters.step_size, tolerance,
                  tolerance == parameters.tolerance ? 1 : 0, solution.iterations,
                  solution.reached_tolerance ? 1 : 0, best.reached_tolerance ? 1 : 0,
                  rms(moved_by_difference(reference.mesh, solution.mesh, best.mesh)),
                  rms(best.mesh), rms(mesh));
    }
}

void run(Options options) {
    print_row("depth", "step_size", "tolerance", "is_default", "iterations", "reached_tolerance",
              "tightest_reached", "solver_rms", "discretisation_rms", "moved");
    const TriangleMesh mesh = named_mesh(options.mesh);
    FlowParameters parameters = parse_configuration(options.configuration);
    parameters.boundary = BoundaryCondition::Free;
    if (std::count(options.tolerances.begin(), options.tolerances.end(), parameters.tolerance) ==
        0) {
        options.tolerances.push_back(parameters.tolerance);
    }
    for (const double step_size : options.step_sizes) {
        const auto references = cotangent_flow(mesh, step_size, {options.steps});
        for (const int depth : options.depths) {
            parameters.depth = depth;
            parameters.step_size = step_size;
            measure(mesh, references.at(options.steps), options, parameters);
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
        "along the normal, in diagonals of the initial bounding box, where the cotangent flow's "
        "triangles are sound. Boundaries are free. The default tolerance is measured too.");
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
