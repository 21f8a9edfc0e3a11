// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/element_multigrid.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"
#include "filter_tracked_mcf/core/flow/solver/vertex_octree.h"

namespace tracked_mcf {

/// The outcome of a solve.
struct MeshConvergence {
    int iterations = 0;  ///< of the part that took most
    /// Norm of the residual that the preconditioner defines, relative to that of x = 0: about the
    /// error in the energy norm. That of the worst part; not finite if the numbers are not.
    double error_estimate = 0;
    double residual_before = 0;  ///< 2-norm over the three coordinates, of x = 0
    double residual_after = 0;
};

/// Returns the larger of two error estimates, or the one that is not a number.
inline double worse_of(double a, double b) {
    return std::isnan(a) || a >= b ? a : b;
}

/// Solves the systems of a flow on the mesh by conjugate gradients, for the three coordinates at
/// once, which share their step lengths. The preconditioner B adds up two corrections: an
/// incomplete Cholesky factorisation of each block of vertices, and for waves of many edges a
/// V-cycle on the levels of the tracked octree. Both are symmetric and positive, and so is their
/// sum.
///
/// The parts of a surface are independent systems: A and B have no entries between them. So each
/// has its own step lengths, unit and end of the iteration. Its solution is the same, to the bit,
/// as that of the part's rows alone, if no octree is used. The cells of an octree follow from all
/// parts; through them, other parts change a solution within the tolerance. Parts of a few vertices
/// are solved exactly.
///
/// Vectors are single precision. If a tolerance is too small for it, iterative refinement reaches
/// it: it sums the solution and computes its residual in double.
class MeshSolver {
public:
    /// `parts` has the part of each vertex, see PartBlocks. Parts without a held vertex keep their
    /// centroids. All arguments must outlive this.
    MeshSolver(const Stars& stars, const std::vector<std::uint8_t>& held,
               const std::vector<std::int32_t>& parts);

    /// Makes the next systems use an octree, in the parts where it has functions; without one,
    /// waves of many edges take many iterations.
    void use(std::unique_ptr<VertexOctree> octree);

    /// Takes the system of the next step, see MeshSystem::take().
    void take(const TriangleElements& elements, double step_size, bool takes_stiffness = true);

    /// Solves A x = b. Held vertices must have a zero in b. Parts that the octree does not help go
    /// on without it, also in later solves.
    MeshConvergence solve(const Field& b, double tolerance, std::vector<Eigen::Vector3d>& x);

    const MeshSystem& system() const { return system_; }
    /// Returns the octree, or null if no part uses one.
    const VertexOctree* octree() const { return octree_.get(); }

private:
    using Block = PartBlocks::Block;
    using Parts = std::vector<std::int32_t>;

    /// The state of a part's solve, in which b is divided by `unit`.
    struct Part {
        bool is_held = false;  ///< whether a vertex is
        bool is_tiny = false;  ///< whether MeshSystem::solve() can solve it
        bool has_octree = false;
        bool is_active = false;  ///< whether for_each_active() visits it
        bool is_mended = false;  ///< whether B has changed in this round
        double unit = 1;
        double first = 0;     ///< r·Br of x = 0
        double square = 0;    ///< r·Br now; negative if the octree's part of it is
        double before = 0;    ///< r·Br at the start of this round,
        double previous = 0;  ///< and before this iteration
        double limit = 0;     ///< the round ends at this square,
        int most = 0;         ///< or after these iterations
        int iterations = 0;   ///< of all rounds
        float step = 0;       ///< along p_, of this iteration
        float keep = 0;       ///< of p_, in the next one
    };

    /// Makes these parts active, in increasing order, and no others.
    void activate(Parts parts);
    /// Keeps those parts active for which goes_on(part) holds.
    template <class GoesOn>
    void keep_active(const GoesOn& goes_on);
    /// Returns those of `parts` for which chosen(part) holds.
    template <class Chosen>
    Parts choose(const Parts& parts, const Chosen& chosen) const;
    /// Calls body(part, number of a block) for the blocks of active parts, in parallel.
    template <class Body>
    void for_each_active(const Body& body);
    /// Returns the sum of sums_ over the blocks of a part.
    double sum_of(std::int32_t part) const;

    /// Sets b_ to b, divided by the units of the parts. Returns the norm of b.
    double scale(const Field& b);
    /// Sets r_ = b_ and `first` of active parts.
    void begin();
    /// Solves for the active parts that are tiny, and updates their r_, z_ and `square`.
    void solve_tiny_parts(std::vector<Eigen::Vector3d>& x);
    /// Makes conjugate gradients in the active parts, from x_ = 0, given z_ = B r_. A part ends at
    /// its limit, or after as many iterations as are worth it. No part is active then.
    void descend();
    /// Sets z_ = B r_ and `square` of active parts. If it moves, it adds step * p_ to x_ and takes
    /// step * q_ from r_ before.
    void precondition(bool moves);
    /// Sets z_ = B r_ and `square` of active parts, with a B for which no square is negative.
    void precondition_positively();
    /// Widens the spectrum of the octree's V-cycle if it is not positive in a part. Parts go on
    /// without an octree if that is not possible, or if the V-cycle does not help.
    void mend_octree(const Parts& failed);
    /// Returns the logarithm of the largest reduction of a square that active parts still need.
    double reduction_left() const;
    /// Adds to each part that nothing holds the translation that its residual asks for, and
    /// multiplies x by the units. Returns the norm of the residual.
    double finish(std::vector<Eigen::Vector3d>& x);

    MeshSystem system_;
    std::vector<Part> parts_;
    Parts active_, active_chunks_;  ///< parts, and the chunks of PartBlocks that they have
    std::vector<double> sums_;      ///< workspace, per block
    std::unique_ptr<VertexOctree> octree_;
    std::optional<ElementMultigrid> multigrid_;
    MatrixBlocks matrices_;
    Field b_, x_, r_, z_, p_, q_, coarse_b_, coarse_x_;
};

}  // namespace tracked_mcf
