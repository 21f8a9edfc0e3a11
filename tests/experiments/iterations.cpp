// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/solver/conjugate_gradients.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"
#include "filter_tracked_mcf/core/system/stabilization.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/support/elements.h"

namespace tracked_mcf::experiments {

namespace {

/// The system of the first step on one octree, for any step size and stabilisation weight.
class FirstStep {
public:
    FirstStep(const TriangleMesh& mesh, int depth, bool separate_sheets)
        : grid_(enclosing_grid(mesh, depth)),
          cells_per_side_(longest_side(mesh) / grid_.cell_size),
          elements_(build_tracked_elements(mesh, grid_, Cubature::ThreePoints, separate_sheets)),
          stabilization_(elements_),
          multigrid_(elements_, constrained_unknowns(elements_, BoundaryCondition::Free)) {}

    void assemble(double step_size) {
        step_size_ = step_size * cells_per_side_ * cells_per_side_;
        assemble_elements(elements_, Coefficients::Zero(elements_.finest().unknown_count(), 3),
                          {1, static_cast<float>(step_size_)}, systems_);
    }

    Convergence solve(const FlowParameters& parameters) {
        // The multigrid refers to these matrices during the solve.
        MatrixBlocks matrices = systems_.matrices;
        stabilization_.add(stabilization_of(parameters), step_size_, matrices);
        multigrid_.refresh(matrices, step_size_);
        multigrid_.assemble(systems_.right_sides, right_side_);
        Coefficients solution;
        Field earlier_guess;
        return ConjugateGradients().solve(multigrid_, right_side_, parameters.tolerance,
                                          kMaximumSolverIterations, solution, earlier_guess);
    }

    std::int32_t unknown_count() const { return elements_.finest().unknown_count(); }

private:
    Grid grid_;
    double cells_per_side_;
    TrackedElements elements_;
    Stabilization stabilization_;
    ElementMultigrid multigrid_;
    double step_size_ = 0;
    ElementSystems systems_;
    Field right_side_;
};

void run(const Options& options) {
    print_row("depth", "step_size", "configuration", "unknowns", "iterations", "error_estimate",
              "reached_tolerance");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int depth : options.depths) {
        FirstStep step(mesh, depth, FlowParameters().separate_sheets);
        for (const double step_size : options.step_sizes) {
            step.assemble(step_size);
            for (const std::string& configuration : options.configurations) {
                const Convergence convergence = step.solve(parse_configuration(configuration));
                print_row(depth, step_size, configuration, step.unknown_count(),
                          convergence.iterations, convergence.error_estimate,
                          convergence.reached_tolerance ? 1 : 0);
            }
        }
    }
}

}  // namespace

void add_iterations(CLI::App& app) {
    add_experiment(app, "iterations",
                   "Prints the solver's iterations and error estimate in the first step.", run,
                   Options());
}

}  // namespace tracked_mcf::experiments
