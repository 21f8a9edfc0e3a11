// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow_state.h"
#include "filter_tracked_mcf/core/flow/preserving.h"
#include "filter_tracked_mcf/core/flow/stepper.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/plan/plan.h"

namespace tracked_mcf {

/// A mean-curvature flow: set up once from the initial surface, then advanced step by step.
///
/// Hosts call evolve(), which validates the input, reports progress and writes the result back.
/// Flow is for callers that look at every step.
class Flow {
public:
    /// Sets up a flow. If the plan preserves anything, the mesh must outlive the flow and keep its
    /// positions. Throws InvalidMesh if all triangles are degenerate.
    explicit Flow(Plan plan);
    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;

    /// Makes one step (Stepper::advance) and restores what is preserved. A step that fails is
    /// retried with more care: whole, then in 4 substeps, then in 16.
    ///
    /// Returns false and keeps the state if all of these fail; report().stop then says why. Where
    /// the previous step has left almost no area, this step undoes it instead, and returns false.
    ///
    /// Throws what poll_progress() throws; the flow cannot be continued then.
    bool step();

    /// Takes the flow back to before the last step and ends it, with `reason` as report().stop.
    /// Call it at most once after a step.
    void end_before_last_step(Stop reason);

    /// Moves vertices from their initial positions to where the flow has brought them. `positions`
    /// are those of the mesh that the flow was made from. Vertices that do not move keep their
    /// bits.
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const;

    /// Returns the velocity of the last step (FlowState::velocity) at each of `vertex_count`
    /// vertices, in 1 / mesh units. If no step was made, it is that of a short step, which is made
    /// for this. Where the surface has densities ρ (densities.h), the step size is δ / ρ of the
    /// vertex's element. Zero at vertices that do not move, and unless the plan takes velocities.
    std::vector<Eigen::Vector3d> velocities(std::size_t vertex_count);

    const FlowReport& report() const { return report_; }
    const FlowState& state() const { return state_; }
    const Stepper& stepper() const { return stepper_; }

private:
    void fill_report(const Plan& plan);
    /// Makes a step in substeps of the same size.
    StepResult advance(int substeps, const Care& care, StepReport& report);

    Stepper stepper_;
    std::optional<Preserver> preserver_;
    FlowState state_;
    FlowState before_;  ///< the state before the last step
    FlowReport report_;
};

}  // namespace tracked_mcf
