// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
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
    int iterations = 0;
    /// Norm of the residual that the preconditioner defines, relative to that of x = 0: about the
    /// error in the energy norm. Not finite if the numbers are not.
    double error_estimate = 0;
    double residual_before = 0;  ///< 2-norm over the three coordinates, of x = 0
    double residual_after = 0;
};

/// Solves the systems of a flow on the mesh by conjugate gradients, for the three coordinates at
/// once, which share their step lengths. The preconditioner B adds up two corrections: an
/// incomplete Cholesky factorisation of each chunk of vertices, and for waves of many edges a
/// V-cycle on the levels of the tracked octree. Both are symmetric and positive, and so is their
/// sum.
///
/// Vectors are single precision. If a tolerance is too small for it, iterative refinement reaches
/// it: it sums the solution and computes its residual in double.
class MeshSolver {
public:
    /// `components` has the connected component of each vertex. Components without a vertex that
    /// stays keep their centroids. All arguments must outlive this.
    MeshSolver(const Stars& stars, const std::vector<std::uint8_t>& fixed,
               const std::vector<std::int32_t>& components);

    /// Makes the next systems use an octree; without one, waves of many edges take many iterations.
    void use(std::unique_ptr<VertexOctree> octree);

    /// Takes the system of the next step, see MeshSystem::take().
    void take(const TriangleElements& elements, double step_size, bool takes_stiffness = true);

    /// Solves A x = b. Vertices that stay must have a zero in b. If the octree does not help, goes
    /// on without it, also in later solves.
    MeshConvergence solve(const Field& b, double tolerance, std::vector<Eigen::Vector3d>& x);

    const MeshSystem& system() const { return system_; }
    /// Returns the octree, or null.
    const VertexOctree* octree() const { return octree_.get(); }

private:
    /// Iterates from x_ = 0 until r·Br, given that of r_, is at most `limit`, or there are as many
    /// iterations as are worth it. Returns what it is.
    double descend(double square, double limit, int& iterations);
    /// Widens the spectrum of the octree's V-cycle if r·Br, `square`, is negative. Goes on without
    /// an octree if that is not possible, or if its V-cycle does not help.
    void mend_octree(double square);
    /// Sets r_ = b and z_ = B r_. Returns r·z, with a B for which it is not negative.
    double begin(const Field& b);
    /// Moves x_ by step * p_, and r_ likewise; sets z_ = B r_. Returns r·z, or less than 0 if that
    /// part of it is negative which is the octree's.
    double precondition(float step);
    /// Adds to each component that nothing holds the translation that its residual asks for.
    void remove_drift(std::vector<Eigen::Vector3d>& x) const;

    MeshSystem system_;
    const std::vector<std::int32_t>& components_;
    std::vector<std::uint8_t> is_held_;  ///< per component: whether a vertex stays
    std::unique_ptr<VertexOctree> octree_;
    std::optional<ElementMultigrid> multigrid_;
    MatrixBlocks matrices_;
    Field x_, r_, z_, p_, q_, coarse_b_, coarse_x_;
};

}  // namespace tracked_mcf
