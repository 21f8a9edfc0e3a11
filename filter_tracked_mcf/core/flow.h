#pragma once

#include <memory>
#include <optional>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/held_curve.h"
#include "filter_tracked_mcf/core/stabilization.h"
#include "filter_tracked_mcf/core/step_solver.h"
#include "filter_tracked_mcf/core/supports.h"
#include "filter_tracked_mcf/core/tracked_elements.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "filter_tracked_mcf/core/vanished_parts.h"

namespace tracked_mcf {

/// From this share of its initial area on, a surface counts as vanished.
inline constexpr double kVanishedArea = 1e-3;

/// A mean-curvature flow under way: set up once from the initial surface, then stepped. What is
/// tracked never changes; what a step changes is the displacement of the embedding.
///
/// Hosts call evolve(), which validates, reports progress and writes back; this is for those who
/// want to look at every step.
class Flow {
public:
    /// Sets up for a mesh and parameters that validate() accepts, on the grid that encloses all of
    /// the mesh, be all of it selected or not. Throws InvalidMesh if all triangles are degenerate,
    /// NotEnoughMemory if the flow is expected not to fit into what is free, and what Domain
    /// throws.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters,
         const Selection& selection = {});

    /// The same on a grid of the caller's choice, which must enclose the selected triangles.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters, const Grid& grid,
         const Selection& selection = {});

    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;

    /// Solves (D + δS) d = -δ S x(t) for the displacement d = x(t+δ) - x(t), which is equation 2,
    /// stabilised if so asked, and adds it. Throws NumericalFailure if it is not finite, leaving
    /// the embedding as it was.
    ///
    /// Throws what poll_progress() throws; then the flow is over.
    ///
    /// Returns false if there is nothing left to do, as report().stop then says: where the last
    /// step left next to no area it is taken back.
    bool step();

    /// Takes the last step back, and gives `reason` as report().stop; once after a step. Then the
    /// flow is over.
    void take_back(Stop reason);

    /// Scales the embedding about `centre` (mesh units) by `factor`, to undo what steps do to its
    /// size. The next step is expected to need the same again: solved for is then what it does
    /// besides. Else the stabilisation, which holds the thickness of the space around the surface,
    /// and the functions that hardly meet the surface, would grow with every scaling.
    void scale(const Eigen::Vector3d& centre, double factor);

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
    /// The clipped surface, and the memory that all of the flow is expected to need.
    struct Start;
    static Start start(const TriangleMesh& mesh, const Domain& domain,
                       const FlowParameters& parameters);
    static Start start(const Domain& domain, const FlowParameters& parameters, const Grid& grid);

    Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters);
    Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters,
         const Grid& grid);
    Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters,
         Start start);

    bool can_move() const;
    bool holds_curve() const { return parameters_.boundary != BoundaryCondition::LockedCells; }
    void assemble(StepReport& report);
    void anchor_what_has_pinched();
    const Supports& supports();
    void solve(StepReport& report);
    void fill_report(const Domain& domain);

    FlowParameters parameters_;
    FlowReport report_;
    TrackedElements elements_;
    double grid_step_size_;
    std::unique_ptr<StepSolver> solver_;
    Stabilization stabilization_;
    std::optional<Supports> supports_;             ///< measured when first needed
    std::optional<VanishedParts> vanished_parts_;  ///< of a conformalized flow
    HeldCurve held_curve_;
    Coefficients displacement_;
    Coefficients previous_;  ///< displacement before the last step
    Coefficients guess_;     ///< what the next step is expected to do; empty for nothing

    // Refilled by every step.
    ElementSystems systems_;
    Coefficients solution_;
};

}  // namespace tracked_mcf
