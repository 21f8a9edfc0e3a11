// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/solver/paper/multigrid.h"
#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// The paper's flow: the octree's finite elements, restricted to the surface and tracked with it
/// (section 4), and a fixed number of W-cycles of multigrid in each step (section 5.2). A boundary
/// that is not free locks the cells that it meets (section 5.3). A step of order 1 solves
/// (D + δS) d = -δ S x(t) for the displacement d = x(t+δ) - x(t), which is equation 2; one of order
/// m solves m times, see FlowParameters::order.
class PaperFlow : public SurfaceFlow {
public:
    /// Throws InvalidMesh if all triangles are degenerate.
    explicit PaperFlow(PaperPlan plan);

    /// The step fails if it takes a vertex out of the initial bounding box by more than a tenth of
    /// the box's diagonal: the flow obeys a maximum principle, but for the error of the grid.
    bool step() override;
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const override;
    std::vector<double> mean_curvatures(const Positions& after) override;

    const TrackedElements& elements() const { return elements_; }
    /// Returns the coefficients of X_t minus the identity, in grid units.
    const Coefficients& displacement() const { return displacement_; }

private:
    void take_last_step_back() override;
    /// Solves the system with these right-hand sides for d_.
    void solve(const Field& right_sides, StepReport& report);
    /// Returns whether the vertices are where a step can lead.
    bool is_confined(const Coefficients& displacement) const;

    const int order_, cycles_;
    const double step_size_;  ///< δ, in squared sides of a cell
    const TrackedElements elements_;
    Multigrid multigrid_;
    Coefficients displacement_, before_;  ///< now, and before the last step
    double first_area_ = 0;               ///< of the surface in the first step, grid units²
    ElementSystems systems_;
    Coefficients d_;                   ///< the displacement of the last step
    Field right_side_, x_, residual_;  ///< workspaces
};

}  // namespace tracked_mcf
