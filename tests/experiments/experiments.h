#pragma once

namespace CLI {
class App;
}

/// The experiments' programs, each a subcommand of tracked_mcf_experiments. They print CSV with a
/// header on standard output; the scripts beside them choose the cases, and make tables and plots.
namespace tracked_mcf::experiments {

/// Separated sheets against glued ones, where the mesh's edges lie in the grid's planes.
void add_aligned(CLI::App& app);

/// Distance to the cotangent flow after some numbers of steps.
void add_accuracy(CLI::App& app);

/// The surface beside a held boundary, against the cotangent flow.
void add_boundary(CLI::App& app);

/// Iterations of the solver in the first step.
void add_iterations(CLI::App& app);

/// Distance to a minimal surface that a held boundary spans.
void add_minimal(CLI::App& app);

/// Long flows: what becomes of parts that pinch.
void add_pinches(CLI::App& app);

/// Disjoint pieces closer than a cell, together and alone.
void add_pieces(CLI::App& app);

/// How often the progress callback is called, and what that costs.
void add_progress(CLI::App& app);

/// Size and time of the set-up.
void add_setup(CLI::App& app);

/// Radius of the unit sphere against the exact semi-implicit one.
void add_sphere(CLI::App& app);

/// Stages of a flow: area, and how near a sphere the surface is.
void add_stages(CLI::App& app);

/// What a tolerance costs in accuracy.
void add_tolerance(CLI::App& app);

}  // namespace tracked_mcf::experiments
