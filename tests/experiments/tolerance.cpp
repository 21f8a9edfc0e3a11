// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/experiments/reference.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

struct ToleranceOptions : Options {
    std::vector<double> tolerances;
    double tightest = 1e-9;
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
    flow.move_vertices(solution.mesh.positions);
    return solution;
}

/// Returns the reference with its vertices moved by a - b.
TriangleMesh moved_by_difference(TriangleMesh reference, const TriangleMesh& a,
                                 const TriangleMesh& b) {
    for (std::size_t i = 0; i < reference.positions.size(); ++i) {
        reference.positions[i] += a.positions[i] - b.positions[i];
    }
    return reference;
}

void measure(const TriangleMesh& mesh, const Reference& reference, const ToleranceOptions& options,
             const FlowParameters& parameters) {
    const double unit = diagonal(mesh);
    const auto rms = [&](const TriangleMesh& m) {
        return normal_distance(m, reference.mesh, reference.left_out).rms / unit;
    };
    const Solution best = solve(mesh, parameters, options.tightest, options.last_step());
    std::vector<double> tolerances = options.tolerances;
    const auto usual = std::find(tolerances.begin(), tolerances.end(), parameters.tolerance);
    if (usual == tolerances.end()) tolerances.push_back(parameters.tolerance);
    for (const double tolerance : tolerances) {
        const Solution solution = solve(mesh, parameters, tolerance, options.last_step());
        print_row(parameters.depth, parameters.step_size, tolerance,
                  tolerance == parameters.tolerance ? 1 : 0, solution.iterations,
                  solution.reached_tolerance ? 1 : 0, best.reached_tolerance ? 1 : 0,
                  rms(moved_by_difference(reference.mesh, solution.mesh, best.mesh)),
                  rms(best.mesh), rms(mesh));
    }
}

void run(const ToleranceOptions& options) {
    print_row("depth", "step_size", "tolerance", "is_default", "iterations", "reached_tolerance",
              "tightest_reached", "solver_rms", "discretisation_rms", "moved");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const double step_size : options.step_sizes) {
        const auto references = cotangent_flow(mesh, step_size, options.steps);
        options.for_each_case([&](int depth, const std::string& configuration) {
            FlowParameters parameters = options.parameters(depth, configuration);
            parameters.boundary = BoundaryCondition::Free;
            parameters.step_size = step_size;
            measure(mesh, references.at(options.last_step()), options, parameters);
        });
    }
}

}  // namespace

void add_tolerance(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "tolerance",
        "Prints the solver's error (distance to the solution at the tightest tolerance) and the "
        "discretisation's (distance of that solution to the cotangent flow): root mean squares "
        "along "
        "the normal, in diagonals of the initial bounding box, where the cotangent flow's "
        "triangles "
        "are sound. Boundaries are free. Measures the default tolerance, too.",
        run, ToleranceOptions());
    command->add_option("--tolerances", options->tolerances)->required();
    command->add_option("--tightest", options->tightest);
}

}  // namespace tracked_mcf::experiments
