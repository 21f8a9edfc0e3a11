#pragma once

#include "filter_tracked_mcf/core/conjugate_gradients.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/multigrid.h"
#include "filter_tracked_mcf/core/stabilization.h"
#include "filter_tracked_mcf/core/supports.h"
#include "filter_tracked_mcf/core/tracked_elements.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A mean-curvature flow under way: set up once from the initial surface, then stepped. What is
/// tracked never changes; what a step changes is the displacement of the embedding.
///
/// Hosts call evolve(), which validates, reports progress and writes back; this is for those who
/// want to look at every step.
class Flow {
public:
    /// Sets up for a mesh and parameters that validate() accepts. Throws InvalidMesh if all
    /// triangles are degenerate.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters);

    /// The same on a grid of the caller's choice, which must enclose the mesh.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters, const Grid& grid);

    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;

    /// Solves (D + δS) d = -δ S x(t) for the displacement d = x(t+δ) - x(t), which is equation 2,
    /// stabilised if so asked, and adds it. Throws NumericalFailure if it is not finite, leaving
    /// the embedding as it was.
    void step();

    /// Moves the vertices of the mesh that the flow was made from, positions as they were then, to
    /// where the flow has brought them. Those that did not move keep their bits.
    void move_vertices(TriangleMesh& mesh) const;

    const FlowReport& report() const { return report_; }
    const TrackedElements& elements() const { return elements_; }
    /// Coefficients of X_t minus the identity, grid units.
    const Coefficients& displacement() const { return displacement_; }
    /// δ in grid units: δ / h², at most 1e5.
    double grid_step_size() const { return grid_step_size_; }

private:
    void assemble(StepReport& report);
    void solve(StepReport& report);
    void solve_by_conjugate_gradients(StepReport& report);
    void solve_by_cycles(StepReport& report);
    void fill_report(const TriangleMesh& mesh);

    FlowParameters parameters_;
    FlowReport report_;
    TrackedElements elements_;
    double grid_step_size_;
    Multigrid multigrid_;
    Stabilization stabilization_;
    Supports supports_;
    Coefficients displacement_;

    // Refilled by every step.
    ElementSystems systems_;
    ConjugateGradients conjugate_gradients_;
    Field right_side_, residual_;
    Coefficients solution_;
};

}  // namespace tracked_mcf
