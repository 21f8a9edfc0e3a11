// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/elements/supports.h"
#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/confinement.h"
#include "filter_tracked_mcf/core/flow/flow_state.h"
#include "filter_tracked_mcf/core/flow/surface_flow.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/plan/plan.h"
#include "filter_tracked_mcf/core/solver/step_solver.h"
#include "filter_tracked_mcf/core/system/curve_constraint.h"
#include "filter_tracked_mcf/core/system/pinches.h"
#include "filter_tracked_mcf/core/system/stabilization.h"

namespace tracked_mcf {

/// How carefully a step is made.
struct Care {
    double tolerance;  ///< see FlowParameters::tolerance
    /// Whether the step's drift is removed (drift.h), and no scaling is predicted.
    bool removes_drift = false;
};

/// The state after a step, or why there is none.
using StepResult = std::variant<FlowState, Stop>;

inline bool has_stopped(const StepResult& result, Stop reason) {
    const Stop* const stop = std::get_if<Stop>(&result);
    return stop != nullptr && *stop == reason;
}

/// Makes the steps of a flow: functions from a state to the next one. After the constructor, only
/// workspaces change: what they hold from earlier steps, such as the guesses that a solver starts
/// from, changes a result by less than the tolerance.
class Stepper {
public:
    Stepper(TrackedElements elements, const StepPlan& plan);
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    /// Returns the state of the initial surface.
    FlowState start() const;

    /// Makes one step of equation 2: solves (D + δS) d = -δ S x(t) for the displacement
    /// d = x(t+δ) - x(t), with the stabilisation and the constraints that the plan asks for, and
    /// adds d to the embedding. A step of order m solves m times, see FlowParameters::order.
    ///
    /// In the code, n is the conormal and λ the multiplier of the curve constraint, C its matrix
    /// and u its displacement; N is the matrix of the stabilisation.
    ///
    /// Returns Stop::Vanished if `from` has almost no area, Stop::NothingMoves if all its
    /// vertices or all its unknowns are constrained, and Stop::StepFailed if the solver reaches
    /// nothing, or if the step takes the surface where it cannot be (confinement.h). Sets the
    /// report's area and collapsed samples to those of `from`, and combines its other numbers with
    /// those of earlier substeps.
    StepResult advance(const FlowState& from, const StepSize& size, const Care& care,
                       StepReport& report);

    /// Returns the displacement z by which the last step that advance() returned answers a pressure
    /// of 1: the solution of its system for the right-hand side ∫ B_I n, with the normal n before
    /// the step. In grid units. Empty unless the plan takes responses.
    const Coefficients& pressure_response() const { return pressure_response_.x; }

    /// Makes the next solves start from zero instead of the last step's solutions.
    void forget_solutions() { solutions_.assign(solutions_.size(), {}); }

    const TrackedElements& elements() const { return elements_; }
    const StepPlan& plan() const { return plan_; }
    const Confinement& confinement() const { return confinement_; }
    /// Returns the number of unknowns that a boundary of locked cells constrains.
    std::int64_t locked_unknown_count() const { return locked_unknown_count_; }
    /// Returns δ, which is at most 1e5 squared sides of a cell.
    const StepSize& size() const { return size_; }

private:
    /// The prediction that each component shrinks about a point (FlowState::scalings).
    struct Prediction {
        Coefficients embedding;      ///< relative to these points; empty if nothing is predicted
        std::vector<double> losses;  ///< the fraction that the step removes, for each component
        std::vector<ElementVector> products;  ///< (D + δS) embedding
        /// Returns the fraction that a step of one order removes of a component, if that of
        /// `all_orders` removes losses[component] = h^all_orders of it.
        double loss(std::int32_t component, int order, int all_orders) const;
    };

    void predict(const std::vector<Scaling>& scalings, const Coefficients& displacement);
    bool predicts() const { return prediction_.embedding.size() > 0; }
    void subtract_prediction(int order);  // b -= A p, with p the prediction for the order
    void constrain_pinches(std::vector<std::uint8_t>& constrained);
    void solve(double tolerance, StepReport& report);  // A d = b, and again for a greater order
    Coefficients step_of(int order) const;
    void respond(const FlowState& from, double tolerance, StepReport& report);
    void remove_drift_from(Coefficients& step, const FlowState& from,
                           const std::vector<std::uint8_t>& constrained) const;
    bool constrains_curve() const { return plan_.boundary != BoundaryCondition::LockedCells; }
    const Supports& supports();

    const StepPlan plan_;
    const TrackedElements elements_;
    const StepSize size_;
    const Stabilization stabilization_;
    const CurveConstraint curve_constraint_;
    const Confinement confinement_;
    std::vector<std::uint8_t> initially_constrained_;  ///< as FlowState::constrained
    std::int64_t locked_unknown_count_ = 0;
    std::optional<VanishedComponents> vanished_components_;  ///< only in a conformalized flow
    std::optional<Supports> supports_;                       ///< measured when first needed

    // Workspaces.
    std::unique_ptr<StepSolver> solver_;
    ElementSystems systems_;
    Prediction prediction_;
    std::vector<Solution> solutions_;  ///< one for each solve of a step; the last one is d
    Solution pressure_response_;
};

}  // namespace tracked_mcf
