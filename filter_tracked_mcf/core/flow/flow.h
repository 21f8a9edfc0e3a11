// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/elements/supports.h"
#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/confinement.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/solver/step_solver.h"
#include "filter_tracked_mcf/core/system/curve_constraint.h"
#include "filter_tracked_mcf/core/system/pinches.h"
#include "filter_tracked_mcf/core/system/stabilization.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A surface whose area is at most this fraction of its initial area has vanished.
inline constexpr double kVanishedArea = 1e-3;

/// The tolerance, at most, to which a step or a flow that has failed is made again.
inline constexpr double kCarefulTolerance = 1e-6;

/// A scaling about a point, in mesh units.
struct Scaling {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double factor = 1;
};

/// A mean-curvature flow: set up once from the initial surface, then advanced step by step.
///
/// The tracked elements never change. A step changes only the displacement, the coefficients of
/// X_t minus the identity.
///
/// Hosts call evolve(), which validates the input, reports progress and writes the result back.
/// Flow is for callers that look at every step.
class Flow {
public:
    /// Sets up a flow on `grid`, which must enclose the domain's surface. Without a grid, the flow
    /// chooses the one that encloses this surface, at the depth that the parameters ask for.
    ///
    /// The mesh and the parameters must have passed validate(). The domain is not needed
    /// afterwards. Throws InvalidMesh if all triangles are degenerate, and NotEnoughMemory if the
    /// flow is expected not to fit into the free memory.
    Flow(const Domain& domain, const FlowParameters& parameters,
         const std::optional<Grid>& grid = {});

    /// Sets up a flow of a mesh.
    Flow(const TriangleMesh& mesh, const FlowParameters& parameters,
         const std::optional<Grid>& grid = {});

    Flow(const Flow&) = delete;
    Flow& operator=(const Flow&) = delete;

    /// Makes one step of equation 2: solves (D + δS) d = -δ S x(t) for the displacement
    /// d = x(t+δ) - x(t), with the stabilisation and the constraints that the parameters ask for,
    /// and adds d to the embedding. A step of order m solves m times, see FlowParameters::order.
    ///
    /// A step fails if it takes the surface where it cannot be (confinement.h), or if the solver
    /// reaches nothing. It is then made again with more care, in one, 4 or 16 parts.
    ///
    /// Returns false, without a step, if nothing is left to do, or if the step has failed in parts,
    /// too; report().stop then says why. If the previous step has left almost no area, that step is
    /// undone.
    ///
    /// Throws what poll_progress() throws; the flow cannot be continued then.
    bool step();

    /// Undoes the last step and ends the flow, with `reason` as report().stop. Call it at most once
    /// after a step.
    void undo_step(Stop reason);

    /// Scales the embedding of each connected component (components.h).
    ///
    /// The next step predicts the same scalings again and solves only for the remainder. Otherwise
    /// the stabilisation, which penalises a change of thickness of the space around the surface,
    /// and the functions that hardly meet the surface would distort the embedding a little at each
    /// scaling.
    void scale(const std::vector<Scaling>& components);

    /// Returns the displacement z by which the last step answers a pressure of 1: the solution of
    /// its system for the right-hand side ∫ B_I n, with the normal n before the step. In grid
    /// units. Valid until the next step.
    const Coefficients& pressure_response();

    /// Adds z times a factor, given for each connected component, to the displacement.
    void inflate(const std::vector<double>& factors);

    /// Moves vertices from their initial positions to where the flow has brought them. `positions`
    /// are those of the mesh that the flow was made from. Vertices that do not move keep their
    /// bits.
    void move_vertices(std::vector<Eigen::Vector3d>& positions) const;

    /// Returns the velocity d/δ of the last step at each of `vertex_count` vertices, in 1 / mesh
    /// units: that of a step of order 1, before anything is preserved. Where the detail size
    /// follows the local edge length, δ is that of the vertex's element. Zero at vertices that do
    /// not move, and unless the parameters' quality asks for the mean curvature.
    std::vector<Eigen::Vector3d> velocities(std::size_t vertex_count) const;

    const FlowReport& report() const { return report_; }
    const TrackedElements& elements() const { return elements_; }
    /// Returns the connected component of each finest element.
    const std::vector<std::int32_t>& component_of() const { return component_of_; }
    /// Coefficients of X_t minus the identity, in grid units.
    const Coefficients& displacement() const { return displacement_; }
    /// Returns δ in squared sides of a finest cell; at most 1e5.
    double step_size_in_cells() const { return step_size_in_cells_; }

private:
    /// The clipped surface, and the memory that the whole flow is expected to need.
    struct Start;
    static Start start(const Domain& domain, const FlowParameters& parameters,
                       const std::optional<Grid>& grid);

    /// What scale() expects of the next step: that it shrinks each component about a point.
    struct Prediction {
        Coefficients embedding;      ///< relative to these points; empty if nothing is expected
        std::vector<double> losses;  ///< the fraction that the step removes, for each component
        std::vector<ElementVector> products;  ///< (D + δS) embedding
        /// Returns the fraction that a step of one order removes of a component, if that of
        /// `all_orders` removes losses[component] = h^all_orders of it.
        double loss(std::int32_t component, int order, int all_orders) const;
    };
    Flow(const Domain& domain, const FlowParameters& parameters, Start start);

    /// Assembles the system of a step of this size, in squared sides of a cell.
    void prepare(double delta);
    /// Makes the last step again, in parts, to a smaller tolerance and without drift (drift.h).
    /// Returns whether it succeeded.
    bool repeat(int parts, StepReport& report);
    bool succeeded(const StepReport& report) const;
    /// Returns flags, per component, of those that a boundary or a constrained unknown holds.
    std::vector<std::uint8_t> constrained_components() const;

    // The parts of a step, in order. n is the conormal and λ the multiplier of the curve
    // constraint, C its matrix and u its displacement; N is the matrix of the stabilisation.
    void assemble(double delta);              // A = D + δS, b = -δ S x(t)
    void add_curve_constraint(double delta);  // A += δη C, b += δ (n + λ) - δη C u
    void stabilize(double delta);             // A += κ (δ + 0.1) N
    void constrain_unknowns(double delta);    // constrained unknowns: zero rows and columns of A
    void solve(StepReport& report);           // A d = b, and again for a greater order
    void add();                               // x(t+δ) = x(t) + d

    void solve(Solution& solution, StepReport& report);
    bool predicts() const { return prediction_.embedding.size() > 0; }
    void subtract_prediction(int order);  // b -= A p, with p the prediction for the order
    Coefficients step_of(int order) const;
    bool ends_here(const StepReport& report);
    bool constrains_curve() const { return parameters_.boundary != BoundaryCondition::LockedCells; }
    bool updates_multipliers() const {
        return constrains_curve() && parameters_.update_boundary_multipliers;
    }
    const Supports& supports();
    void fill_report(const Domain& domain);

    /// Adds the displacement that the coefficients give each vertex that may move, in mesh units.
    void add_at_vertices(const Coefficients& coefficients,
                         std::vector<Eigen::Vector3d>& vectors) const;

    FlowParameters parameters_;
    FlowReport report_;
    TrackedElements elements_;
    std::vector<std::int32_t> component_of_;
    double step_size_in_cells_;
    std::unique_ptr<StepSolver> solver_;
    Stabilization stabilization_;
    std::optional<Supports> supports_;                       ///< measured when first needed
    std::optional<VanishedComponents> vanished_components_;  ///< only in a conformalized flow
    CurveConstraint curve_constraint_;
    Confinement confinement_;
    double tolerance_ = 0;  ///< of the present solves
    Coefficients displacement_;
    Coefficients previous_;   ///< the displacement before the last step
    Coefficients last_step_;  ///< d of order 1; empty unless the quality needs it
    Prediction prediction_;   ///< of the next step

    // Refilled at every step.
    ElementSystems systems_;
    std::vector<Solution> solutions_;  ///< one for each solve of a step; the last one is d
    Solution pressure_response_;
};

}  // namespace tracked_mcf
