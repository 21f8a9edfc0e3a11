// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): it is not ours
class App;
}

/// The subcommands of tracked_mcf_benchmark. Each prints CSV (rows.h) on standard output. Each run
/// is a separate process with its own peak memory. run_benchmark.py chooses the runs and makes
/// tables.
namespace tracked_mcf::benchmark {

/// Measures our flow.
void add_flow(CLI::App& app);

/// Measures the cotangent flow by Eigen's conjugate gradients with incomplete Cholesky factors.
void add_incomplete_cholesky(CLI::App& app);

/// Measures one linear system, solved to the same error by several solvers.
void add_solvers(CLI::App& app);

/// Measures CGAL's smooth_shape. Adds nothing if CGAL is not enabled.
void add_cgal(CLI::App& app);

}  // namespace tracked_mcf::benchmark
