#pragma once

#include <optional>

namespace tracked_mcf {

/// What happens at the boundary of an open mesh: the edges of one triangle only, once coincident
/// vertices are one.
enum class BoundaryCondition {
    Locked,       ///< the boundary is held, and nothing beside it (held_curve.h)
    LockedCells,  ///< test functions whose support meets the boundary keep their coefficient (5.3)
    Free          ///< nothing is held
};

/// Which flow. Both start alike.
enum class FlowKind {
    MeanCurvature,  ///< mass and stiffness of the present metric
    /// Mass of the present metric, stiffness of the initial one (Kazhdan, Solomon and Ben-Chen,
    /// "Can Mean-Curvature Flow be Modified to be Non-singular?", 2012): nothing pinches, and a
    /// closed surface without handles becomes a sphere.
    Conformalized
};

/// What every step restores by scaling the surface about its centroid.
enum class Rescaling { None, KeepArea, KeepVolume };

/// Where a triangle of a clipped polygon is sampled (section 4.2, Figure 8).
enum class Cubature {
    OnePoint,     ///< the centroid: exact to degree 1; for comparison only, it is inaccurate
    ThreePoints,  ///< the paper's rule: exact to degree 2
    Degree6       ///< exact to degree 6, as many as the mass matrix needs; for validation
};

/// How each step's linear system is solved.
enum class Solver {
    Converged,  ///< conjugate gradients preconditioned by a V-cycle, until the tolerance is reached
    OneWCycle   ///< as in the paper (section 5.2): W-cycles from zero, however far they come
};

inline constexpr int kMaximumDepth = 12;
inline constexpr double kMaximumStepSize = 1e9;
inline constexpr int kMaximumIterations = 1000000;
inline constexpr int kMaximumCycles = 1000;
inline constexpr double kMaximumStabilization = 1e3;
inline constexpr double kDefaultStabilization = 0.01;
inline constexpr double kMaximumSpring = 1e6;
inline constexpr int kMaximumThreads = 1024;

/// The knobs of the flow, with the defaults that suit a scan.
struct FlowParameters {
    /// Octree depth: 2^depth cells along the side of its cube. 0 chooses the depth whose number of
    /// unknowns is nearest the number of referenced vertices; else 1 to kMaximumDepth.
    int depth = 0;

    /// Step size δ for the model scaled so that the longest side of its bounding box is 1. δ is a
    /// time, so a squared length: detail smaller than about √δ is smoothed away by one step.
    /// Greater than 0 and at most kMaximumStepSize; from 1e5 squared cells on, where all of the
    /// step is long since the Laplacian, larger steps act like that one.
    double step_size = 1e-5;

    /// Whether step_size is in squared units of the mesh instead: then finite and greater than 0.
    bool absolute = false;

    /// Number of semi-implicit steps, 1 to kMaximumIterations.
    int iterations = 10;

    FlowKind flow = FlowKind::MeanCurvature;
    BoundaryCondition boundary = BoundaryCondition::Locked;

    /// Stiffness η of the spring that holds a Locked boundary (held_curve.h), greater than 0, at
    /// most kMaximumSpring; and whether what it holds is taken up after each step. If not, or with
    /// another stiffness: for comparison only.
    double boundary_spring = 10;
    bool take_up_boundary = true;

    /// KeepVolume wants a closed surface with consistently oriented triangles; neither goes with
    /// anything held.
    Rescaling rescale = Rescaling::None;

    Cubature cubature = Cubature::ThreePoints;

    /// Whether parts of the surface that share a cell, but are not connected inside it, get
    /// functions of their own. If not, as in the paper, they move together.
    bool separate_sheets = true;

    Solver solver = Solver::Converged;

    /// Converged: a step is solved when the error's energy norm, as conjugate_gradients.h estimates
    /// it, is at most this fraction of the solution's. Greater than 0, less than 1.
    double tolerance = 1e-3;

    /// Weight κ of the stabilisation (stabilization.h), 0 to kMaximumStabilization; 0 is the
    /// paper's system. Unset: kDefaultStabilization if the solver is Converged, which it makes
    /// possible, else 0.
    std::optional<double> stabilization;

    /// Whether test functions of which most has collapsed keep their coefficient (pinches.h). If
    /// not, thin parts explode once they have pinched: for comparison only.
    bool anchor_pinches = true;

    /// OneWCycle: W-cycles in each step, at least 1; the paper uses one.
    int cycles = 1;

    /// OpenMP threads; 0 takes what OpenMP offers (OMP_NUM_THREADS is respected). The result is
    /// the same bits whatever the number. For evolve(); a Flow leaves it to its caller.
    int threads = 0;
};

/// The weight of the stabilisation that these parameters ask for.
double stabilization_of(const FlowParameters& parameters);

/// Throws InvalidParameter naming the first knob that lies outside its range, with the range.
void validate(const FlowParameters& parameters);

}  // namespace tracked_mcf
