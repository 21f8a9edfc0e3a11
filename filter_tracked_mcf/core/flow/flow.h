// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow_state.h"
#include "filter_tracked_mcf/core/flow/preserving.h"
#include "filter_tracked_mcf/core/flow/stepper.h"
#include "filter_tracked_mcf/core/flow/surface_flow.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/plan/plan.h"

namespace tracked_mcf {

/// A flow on the tracked octree's finite elements.
class Flow : public SurfaceFlow {
public:
    /// Sets up a flow. If the plan preserves anything, the mesh must outlive the flow and keep its
    /// positions. Throws InvalidMesh if all triangles are degenerate.
    explicit Flow(Plan plan);

    /// A step that fails is retried with more care: whole, then in 4 substeps, then in 16.
    bool step() override;
    void end_before_last_step(Stop reason) override;
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const override;

    /// Measures velocities(), and is 0 at vertices that do not move.
    std::vector<double> mean_curvatures(const SurfaceView& after,
                                        const Selection& selection) override;

    /// Returns the velocity, in 1 / mesh units, of the last step (FlowState::velocity). If no step
    /// was made, it is that of a short step, which is made for this. Where the surface has
    /// densities ρ (densities.h), the step size is δ / ρ of the vertex's element. Zero at vertices
    /// that do not move, and unless the plan takes velocities.
    std::vector<Eigen::Vector3d> velocities(std::size_t vertex_count);

    const FlowReport& report() const override { return report_; }
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
