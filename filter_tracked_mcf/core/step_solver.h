#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Solves the systems of a flow's steps, by one of the ways of FlowParameters::solver. What does
/// not change between steps is made once.
class StepSolver {
public:
    virtual ~StepSolver() = default;

    /// The finest level's frozen unknowns, which stay zero; more may be frozen before take().
    virtual std::vector<std::uint8_t>& frozen() = 0;

    /// Takes the next step's system, of a step of this size (grid units), which must stay until it
    /// is solved; sets the rows and columns of frozen unknowns to zero in its matrices.
    virtual void take(ElementSystems& systems, double step_size) = 0;

    /// Whether anything may move in the system that was taken.
    virtual bool can_move() const = 0;

    /// Solves it. `solution`, a row per unknown, is that of the last step when this is called, or
    /// empty. Fills in what the report has about the solver.
    virtual void solve(Coefficients& solution, StepReport& report) = 0;
};

/// `elements` must outlive the solver.
std::unique_ptr<StepSolver> make_step_solver(const TrackedElements& elements,
                                             const FlowParameters& parameters);

}  // namespace tracked_mcf
