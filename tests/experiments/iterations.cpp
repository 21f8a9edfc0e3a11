#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/conjugate_gradients.h"
#include "filter_tracked_mcf/core/locked_cells.h"
#include "filter_tracked_mcf/core/stabilization.h"
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

/// The first step's system on one octree, for any step size and weight of the stabilisation.
class FirstStep {
public:
    FirstStep(const TriangleMesh& mesh, int depth, bool separate_sheets)
        : grid_(enclosing_grid(mesh, depth)),
          cells_per_side_(longest_side(mesh) / grid_.cell_size),
          elements_(build_tracked_elements(mesh, grid_, Cubature::ThreePoints, separate_sheets)),
          stabilization_(elements_),
          multigrid_(elements_, no_unknowns(elements_)) {}

    void assemble(double step_size) {
        step_size_ = step_size * cells_per_side_ * cells_per_side_;
        assemble_elements(elements_, Coefficients::Zero(elements_.finest().unknown_count(), 3),
                          {1, static_cast<float>(step_size_)}, systems_);
    }

    Convergence solve(const FlowParameters& parameters) {
        // The multigrid works with these matrices until the solve is over.
        MatrixBlocks matrices = systems_.matrices;
        stabilization_.add(stabilization_of(parameters), step_size_, matrices);
        multigrid_.refresh(matrices, step_size_);
        multigrid_.assemble(systems_.right_sides, right_side_);
        Coefficients solution;
        return ConjugateGradients().solve(multigrid_, right_side_, parameters.tolerance,
                                          kMaximumSolverIterations, solution);
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
    print_row("depth", "step_size", "configuration", "unknowns", "iterations", "relative_residual",
              "reached_tolerance");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int depth : options.depths) {
        FirstStep step(mesh, depth, FlowParameters().separate_sheets);
        for (const double step_size : options.step_sizes) {
            step.assemble(step_size);
            for (const std::string& configuration : options.configurations) {
                const Convergence convergence = step.solve(parse_configuration(configuration));
                print_row(depth, step_size, configuration, step.unknown_count(),
                          convergence.iterations, convergence.relative_error,
                          convergence.reached_tolerance ? 1 : 0);
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
