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
/// incomplete Cholesky factorisation, and for waves of many edges a V-cycle on the levels of the
/// tracked octree. Both are symmetric and positive, and so is their sum.
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
    using Separators = std::vector<Elimination::Separator>;

    /// The state of a part's solve, in which b and x are in this unit.
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
        double energy = 0;    ///< p·Ap of the present direction
        double limit = 0;     ///< the round ends at this square,
        int most = 0;         ///< or after these iterations
        int iterations = 0;   ///< of all rounds
        MeshSystem::Search search;
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
    /// Calls body(part, number of a separator) for those of active parts, in parallel.
    template <class Body>
    void for_each_active(const Separators& separators, const Body& body);
    /// Adds the results of body(separator) to a number of the separator's part, in active parts.
    template <class Body>
    void sum_over(const Separators& separators, double Part::*sum, const Body& body);
    /// Returns the sum of sums_ over the blocks of a part.
    double sum_of(std::int32_t part) const;

    /// Sets the units of the parts by the norms of b. Returns that of the whole of b.
    double choose_units(const Field& b);
    /// Sets r_ to b in the units of the parts, and `first` of active parts.
    void begin(const Field& b);
    /// Solves for the active parts that are tiny, and updates their r_ and `square`.
    void solve_tiny_parts(const Field& b, std::vector<Eigen::Vector3d>& x);
    /// Makes conjugate gradients in the active parts, from x = 0, given precondition(). A part ends
    /// at its limit, or after as many iterations as are worth it. The solution is x_ + step * p_
    /// then, and no part is active.
    void descend();
    /// Takes step * q_ from r_ if it moves. Sets `square` of active parts to r·Br, and z_ to Br
    /// where an octree is used, but where none is to what MeshSystem::solve_lower() gives:
    /// search() completes it, if the iteration goes on.
    void precondition(bool moves);
    /// Adds the octree's part of B to z_ and to the squares of these active parts.
    void precondition_by_octree(const Parts& with_octree);
    /// Does what precondition(false) does, with a B for which no square is negative.
    void precondition_positively();
    /// Computes z_ = Br where wanted(part), given what solve_lower() has given, down to the
    /// separators. The rows inside of blocks are left.
    template <class Wanted>
    void solve_upper_at_separators(const Wanted& wanted);
    /// Makes the next direction p_, q_ = A p_, and the step along it.
    void search();
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
    Field x_, r_, z_, p_, q_, coarse_b_, coarse_x_;
};

}  // namespace tracked_mcf
