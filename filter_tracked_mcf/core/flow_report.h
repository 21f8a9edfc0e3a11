// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"

namespace tracked_mcf {

/// Measurements of one semi-implicit step.
struct StepReport {
    double assemble_seconds = 0;  ///< element matrices of all levels and right-hand side
    double solve_seconds = 0;     ///< the solver, and the update of the embedding
    /// 2-norm of the residual b - A d over the three coordinates and all solves of the step, in
    /// edges or sides of a cell, before the solve (where d = 0) and after it. A step has as many
    /// solves as its order, and another one to preserve the volume.
    double residual_before = 0;
    double residual_after = 0;
    int solver_iterations = 0;  ///< iterations of the linear solvers, or W-cycles, of all solves
    /// Of the solver that converges: the largest estimated error of a solve in the energy norm,
    /// relative to its solution. kNoNumber with W-cycles, which have no tolerance.
    double error_estimate = 0;
    bool reached_tolerance = true;       ///< whether error_estimate <= tolerance
    double area = 0;                     ///< area before the step, mesh units²
    std::int64_t collapsed_samples = 0;  ///< samples ignored because their area has collapsed
};

/// Why a flow ended before its last step.
enum class Stop {
    None,          ///< it made all steps
    Vanished,      ///< the next step would have left no area, and was undone
    Pinched,       ///< preserving would have inflated what has pinched; the step was undone
    NotPreserved,  ///< no pressure restores the volume after a step this large; it was undone
    StepFailed,    ///< the next step failed, and was undone
    Grew,          ///< the next step would have made the surface larger, and was undone
    NothingMoves,  ///< all vertices are held, or all unknowns constrained
};

/// Sizes, durations and results of a whole flow.
struct FlowReport : SmoothingReport {
    std::int64_t unselected_triangles = 0;  ///< that do not, because others are selected
    std::int64_t zero_strength_triangles =
        0;                       ///< that do not, because their vertices' strength is 0
    bool has_strengths = false;  ///< whether vertices have strengths
    /// Handles of all parts of a closed surface under a conformalized flow, else 0.
    std::int64_t genus = 0;
    double mean_edge = 0;        ///< mean edge length of the triangles that flow, mesh units
    double longest_side = 0;     ///< of their bounding box, mesh units
    double step_size = 0;        ///< δ, mesh units²
    double asked_step_size = 0;  ///< larger if δ was limited, see FlowParameters::step_size
    int depth = 0;               ///< of the octree; 0 if there was none
    double cell_size = 0;        ///< side of a finest cell, mesh units
    std::int64_t cells = 0;      ///< occupied cells of the finest level
    std::int64_t elements = 0;   ///< elements of the finest level
    std::int64_t unknowns = 0;   ///< unknowns of the finest level
    /// Of these, those that the paper's locked cells constrain.
    std::int64_t constrained_unknowns = 0;
    std::int64_t fragments = 0;        ///< non-empty intersections of triangles and cells
    std::int64_t split_triangles = 0;  ///< triangles of the fragments' fans
    std::int64_t samples = 0;          ///< quadrature points
    double setup_seconds = 0;
    std::vector<StepReport> steps;  ///< one per step made
    Stop stop = Stop::None;
    /// The peak of the process that was expected before the flow began: the estimate for the flow,
    /// and what the process already had, such as the mesh.
    std::int64_t estimated_memory_bytes = 0;
};

}  // namespace tracked_mcf
