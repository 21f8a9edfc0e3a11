// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/kernels/element_matrix.h"
#include "filter_tracked_mcf/core/solver/field.h"
#include "filter_tracked_mcf/core/system/matrix_blocks.h"

namespace tracked_mcf {

/// The solution of a system, and what the next solve for the same quantity starts from. Both
/// members are empty before the first solve.
struct Solution {
    Coefficients x;  ///< one row per unknown
    Field earlier_guess;
};

/// Solves the linear systems of a flow's steps by one of the methods of Solver. Computes
/// everything that does not change between steps only once.
class StepSolver {
public:
    virtual ~StepSolver() = default;

    /// Takes the matrices of the next step, which must stay valid until the step after it, and the
    /// flags of the finest level's constrained unknowns, which stay zero. Sets the rows and columns
    /// of these unknowns to zero in the matrices. `stiffness_to_mass` is the ratio of δ S to D.
    virtual void take(MatrixBlocks& matrices, const std::vector<std::uint8_t>& constrained,
                      double stiffness_to_mass) = 0;

    /// Returns whether the system that was taken has any free unknown.
    virtual bool has_free_unknowns() const = 0;

    /// Solves the system of the last take() for a right-hand side, given by its elements, and adds
    /// the solver's numbers to the report. `tolerance` is as in FlowParameters; the solver by
    /// W-cycles ignores it, and estimates no error. On entry, `solution` is that of the last step.
    virtual void solve(const std::vector<ElementVector>& right_sides, double tolerance,
                       Solution& solution, StepReport& report) = 0;
};

/// Returns a new solver: the paper's with so many cycles, or with none, the one that converges.
/// `constrained` is what constrained_unknowns() returns; `elements` must
/// outlive the solver.
std::unique_ptr<StepSolver> make_step_solver(const TrackedElements& elements,
                                             std::vector<std::vector<std::uint8_t>> constrained,
                                             int cycles);

}  // namespace tracked_mcf
