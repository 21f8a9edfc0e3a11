// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"
#include "filter_tracked_mcf/core/flow/stepping/preserving.h"
#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// A flow on the mesh's own linear elements. A step of order 1 solves (M + δ L) d = -δ L x for the
/// displacement d, with mass M and stiffness L in the present metric (equation 2 with the
/// functions of the mesh); one of order m solves m times, see FlowParameters::order.
///
/// The finest functions are the mesh's, so the flow is the same for all wavelengths that the mesh
/// has, and sheets that are close move apart. The tracked octree only makes its solver fast.
class MeshFlow : public SurfaceFlow {
public:
    /// Throws InvalidMesh if all triangles are degenerate.
    explicit MeshFlow(MeshPlan plan);

    bool step() override;
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const override;
    std::vector<double> mean_curvatures(const Positions& after) override;

private:
    void take_last_step_back() override;
    /// Makes the solver use an octree of the surface as it is now.
    void use_octree();
    /// Does so before a step if the last one showed that it helps.
    void renew_octree();
    double area_of(const Positions& positions) const;  ///< in squared edges
    /// Solves for the displacement of one step, and for the response to a pressure if `response` is
    /// not null.
    void solve(StepReport& report, Positions* response);
    /// Sets the positions to those after the displacement d_, where a step of order 1 can lead.
    /// Returns whether no vertex leaves the box of its part by more than the margin.
    bool displace(Positions& to) const;
    /// Sets `to` to the positions after one step.
    Stop advance(Positions& to, StepReport& report);

    const StepParameters steps_;
    const double step_size_;              ///< δ, in squared edges
    const int depth_;                     ///< of the octree; 0 chooses it
    const std::vector<float> densities_;  ///< per triangle; empty if all are 1
    Positions positions_;                 ///< of the surface's vertices as they are now, in edges
    std::optional<Preserver> preserver_;
    MeshSolver solver_;
    bool octree_harms_ = false;         ///< whether the solver goes on without one
    Positions before_;                  ///< the positions before the last step; workspace in one
    double first_area_ = 0, area_ = 0;  ///< at the start and after the last step, squared edges
    double margin_ = 0;
    Field right_side_;
    Positions d_;  ///< the displacement of the last step
};

}  // namespace tracked_mcf
