// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// What happens at the boundary of an open mesh: at the edges that have only one triangle after
/// coincident vertices have been welded.
enum class BoundaryCondition {
    /// Boundary vertices stay. With Method::Paper, so does the surface in all cells around them:
    /// unknowns whose function meets the boundary are constrained (section 5.3).
    Locked,
    Free  ///< the boundary moves
};

/// The kind of flow. The first step is the same for both.
enum class FlowKind {
    MeanCurvature,  ///< mass and stiffness use the present metric
    /// The mass uses the present metric, the stiffness the initial one (Kazhdan, Solomon and
    /// Ben-Chen, "Can Mean-Curvature Flow be Modified to be Non-singular?", 2012). Nothing pinches,
    /// and a closed surface without handles becomes a sphere.
    Conformalized
};

/// What each step preserves of every part (connected component) of the surface.
enum class Preserve {
    None,
    Area,   ///< scales the part about its centroid
    Volume  ///< pushes the part along its normals; a conformalized flow scales it
};

/// The quadrature rule on each split triangle (section 4.2, Figure 8).
enum class Cubature {
    OnePoint,     ///< the centroid, exact to degree 1; inaccurate, for comparison only
    ThreePoints,  ///< the paper's rule, exact to degree 2
    Degree6       ///< 12 points, exact to degree 6, which the mass matrix needs; for validation
};

/// The functions of a flow, and how its linear systems are solved.
enum class Method {
    /// The mesh's own linear elements, by conjugate gradients to a tolerance. The tracked octree
    /// preconditions them. A cell limits nothing.
    Converged,
    /// The paper's: the tracked octree's elements alone, and a fixed number of W-cycles from zero
    /// (section 5.2). It flows the whole mesh with one detail size, and preserves nothing.
    Paper
};

/// What a flow measures at each vertex, besides moving it.
enum class Quality {
    None,
    /// How far the vertex has moved along the normal of the result, mesh units.
    Displacement,
    /// Mean curvature, half the sum of the principal curvatures, in 1 / mesh units; positive on a
    /// sphere whose normals point outwards. It is that of the surface after the last step, smoothed
    /// over about an edge.
    MeanCurvature
};

inline constexpr int kMaximumDepth = 12;
inline constexpr int kMaximumIterations = 1000000;
inline constexpr int kMaximumOrder = 4;
/// The default detail size, in mean edge lengths of the triangles that flow.
inline constexpr double kDefaultDetailInEdges = 3;
/// A mesh has no finer detail than this, in the same unit.
inline constexpr double kFinestDetailInEdges = 2;

/// The parameters of a flow that each step takes as they are.
struct StepParameters {
    /// Order m of a step, 1 to kMaximumOrder. With h = (D + δS)⁻¹ δS, which is nearly 0 for waves
    /// much longer than √δ and nearly 1 for much shorter ones, a step takes x to x - hᵐ x. Order 1
    /// is equation 2. A greater order takes one more solve each, and keeps long waves better.
    int order = 2;

    FlowKind flow = FlowKind::MeanCurvature;
    BoundaryCondition boundary = BoundaryCondition::Locked;

    /// Converged: each solve of a step ends when its estimate of the error (mesh_solver.h) is at
    /// most this fraction of its solution, both in the energy norm. Greater than 0, less than 1. A
    /// step of order 2 or more may be much smaller than its first solution.
    double tolerance = 1e-3;
};

/// The parameters of a flow, with defaults for a scan. Their names in hosts, help and ranges are in
/// parameter_table.h.
struct FlowParameters : StepParameters {
    /// Octree depth, 1 to kMaximumDepth: the octree's cube has 2^depth cells along each side. 0
    /// chooses it; with Method::Paper, so that there are about as many unknowns as vertices.
    int depth = 0;

    /// Detail size ℓ, mesh units: after all steps, a wave of length ℓ on a plane keeps half its
    /// amplitude. Shorter waves keep less, longer ones more. Finite and at least 0, where 0 is
    /// kDefaultDetailInEdges mean edge lengths.
    double detail_size = 0;

    /// Step size δ, mesh units²; finite and at least 0. 0 takes the one that belongs to the detail
    /// size, see step_size_for(); any other replaces it.
    double step_size = 0;

    /// Number of semi-implicit steps, 1 to kMaximumIterations.
    int iterations = 3;

    /// Volume needs triangles that can be oriented alike. The volume between the initial surface
    /// and the present one stays zero, so the surface may be open, and vertices held. Area, and
    /// Volume in a conformalized flow, allow no held vertices; the latter needs a closed surface.
    Preserve preserve = Preserve::None;

    /// For FlowReport::quality.
    Quality quality = Quality::None;

    Method method = Method::Converged;

    Cubature cubature = Cubature::ThreePoints;  ///< of Method::Paper

    /// Method::Paper: number of W-cycles per step, 1 to 1000; the paper uses one.
    int cycles = 1;

    /// Number of threads; 0 takes ThreadTeam::default_size(). The result has the same bits for any
    /// number. evolve() applies it; a flow does not.
    int threads = 0;
};

/// Returns the step size δ at which `iterations` steps of this order halve the amplitude of waves
/// of length `detail_size` on a plane; in the squared unit of the detail size. A step multiplies
/// the amplitude of waves of length λ by 1 - hᵐ, where h = δk² / (1 + δk²) and k = 2π/λ.
double step_size_for(double detail_size, int iterations, int order);

/// Returns the length of the waves whose amplitude the steps halve: the inverse of step_size_for().
double detail_size_for(double step_size, int iterations, int order);

/// Returns the detail size that the parameters ask for if a mesh has edges of this mean length.
double detail_size_of(const FlowParameters& parameters, double mean_edge);

/// Throws InvalidParameter if a parameter is outside its range (parameter_table.h), or asks for
/// what Method::Paper does not have. The message says what to give instead.
void validate(const FlowParameters& parameters);

}  // namespace tracked_mcf
