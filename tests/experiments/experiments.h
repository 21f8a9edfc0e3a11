#pragma once

namespace CLI {
class App;
}

/// The experiments' programs, each a subcommand of tracked_mcf_experiments. They print CSV with a
/// header on standard output; the scripts beside them choose the cases, and make tables and plots.
namespace tracked_mcf::experiments {

/// Distance to the cotangent flow after some numbers of steps.
void add_accuracy(CLI::App& app);

/// Iterations of the solver in the first step.
void add_iterations(CLI::App& app);

/// Radius of the unit sphere against the exact semi-implicit one.
void add_sphere(CLI::App& app);

/// What a tolerance costs in accuracy.
void add_tolerance(CLI::App& app);

}  // namespace tracked_mcf::experiments
