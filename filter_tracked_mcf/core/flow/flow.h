// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/flow/flow_state.h"
#include "filter_tracked_mcf/core/flow/preserving.h"
#include "filter_tracked_mcf/core/flow/stepper.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Upper bound of the tolerance when a failed step or flow is retried.
inline constexpr double kCarefulTolerance = 1e-6;

/// A mean-curvature flow: set up once from the initial surface, then advanced step by step.
///
/// Hosts call evolve(), which validates the input, reports progress and writes the result back.
/// Flow is for callers that look at every step.
class Flow {
public:
    /// Sets up a flow on `grid`, which must enclose the domain's surface. Without a grid, the flow
    /// chooses the one that encloses this surface, at the depth that the parameters ask for.
    ///
    /// The mesh and the parameters must have passed validate() and check_preservable(). The domain
    /// is not needed afterwards; its mesh is if the parameters preserve anything, and must keep its
    /// positions. Throws InvalidMesh if all triangles are degenerate, and NotEnoughMemory if the
    /// flow is expected not to fit into the free memory.
    Flow(const Domain& domain, const FlowParameters& parameters,
         const std::optional<Grid>& grid = {});

    /// Sets up a flow of a mesh.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters,
         const std::optional<Grid>& grid = {});

    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;

    /// Makes one step (Stepper::advance) and restores what is preserved. A step that fails is made
    /// again with more care, in one, 4 or 16 substeps.
    ///
    /// Returns false and keeps the state if there is no such step; report().stop then says why. If
    /// the previous step has left almost no area, takes the flow back to before that step.
    ///
    /// Throws what poll_progress() throws; the flow cannot be continued then.
    bool step();

    /// Takes the flow back to before the last step and ends it, with `reason` as report().stop.
    /// Call it at most once after a step.
    void end_before_last_step(Stop reason);

    /// Takes the flow back to the initial surface, and makes the steps from then on to the
    /// tolerance kCarefulTolerance.
    void restart_with_care();

    /// Moves vertices from their initial positions to where the flow has brought them. `positions`
    /// are those of the mesh that the flow was made from. Vertices that do not move keep their
    /// bits.
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const;

    /// Returns the velocity of the last step (FlowState::velocity) at each of `vertex_count`
    /// vertices, in 1 / mesh units. If no step was made, it is that of a short step, which is made
    /// for this. Where the detail size follows the local edge length, δ is that of the vertex's
    /// element. Zero at vertices that do not move, and unless the parameters' quality asks for the
    /// mean curvature.
    std::vector<Eigen::Vector3d> velocities(std::size_t vertex_count);

    const FlowReport& report() const { return report_; }
    Stepper& stepper() { return stepper_; }
    const TrackedElements& elements() const { return stepper_.elements(); }
    /// Coefficients of X_t minus the identity, in grid units.
    const Coefficients& displacement() const { return state_.displacement; }
    const StepSize& step_size() const { return stepper_.size(); }

private:
    /// The clipped surface, and the memory that the whole flow is expected to need.
    struct Start;
    static Start start(const Domain& domain, const FlowParameters& parameters,
                       const std::optional<Grid>& grid);
    Flow(const Domain& domain, const FlowParameters& parameters, Start start);

    void fill_report(const Domain& domain);
    /// Makes a step again with more care, in substeps of the same size.
    StepResult advance_in_substeps(int substeps, const Care& care, StepReport& report);

    FlowParameters parameters_;
    Care care_;  ///< of a step that has not failed yet
    Stepper stepper_;
    std::optional<Preserver> preserver_;
    FlowState state_;
    FlowState before_;  ///< the state before the last step
    /// The state from which the last substep was made, if the step in progress has several.
    std::optional<FlowState> before_substep_;
    FlowReport report_;
};

}  // namespace tracked_mcf
