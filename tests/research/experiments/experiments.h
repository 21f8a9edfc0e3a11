// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): it is not ours
class App;
}

/// The experiments: each is a subcommand of tracked_mcf_experiments that prints CSV with a header
/// on standard output. The scripts in this folder choose the cases and make tables and plots.
namespace tracked_mcf::experiments {

/// Writes the finest cells that a patch carries with it.
void add_cells(CLI::App& app);

/// Compares the radius of the unit sphere with the exact semi-implicit radius.
void add_sphere(CLI::App& app);

/// Measures area and roundness during a flow.
void add_stages(CLI::App& app);

}  // namespace tracked_mcf::experiments
