#pragma once

namespace CLI {
class App;
}

/// What tracked_mcf_benchmark measures, each a subcommand. They print CSV (rows.h) on standard
/// output; every run is a process of its own, so that its peak memory is its own. run_benchmark.py
/// chooses the runs, and makes tables of them.
namespace tracked_mcf::benchmark {

/// Our flow.
void add_flow(CLI::App& app);

/// Our flow without tracking: set up anew from the evolved mesh before every step.
void add_rebuilt(CLI::App& app);

/// The cotangent flow with conjugate gradients and an incomplete factorisation.
void add_baseline(CLI::App& app);

/// CGAL's smooth_shape, if this was built with it.
void add_cgal(CLI::App& app);

/// The machine's memory bandwidth.
void add_triad(CLI::App& app);

}  // namespace tracked_mcf::benchmark
