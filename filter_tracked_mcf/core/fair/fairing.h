// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <cmath>
#include <cstdint>
#include <utility>

#include "filter_tracked_mcf/core/fair/factorisation.h"
#include "filter_tracked_mcf/core/fair/patches.h"

namespace tracked_mcf {

/// The integral of the squared mean curvature over the area of some vertices.
struct Bending {
    double squares = 0, area = 0;
    std::int64_t vertices = 0;

    /// Returns the RMS.
    double curvature() const { return area > 0 ? std::sqrt(squares / area) : 0; }
    /// Returns the RMS angle by which the surface turns from vertex to vertex.
    double turn() const {
        return vertices > 0 ? std::sqrt(squares / static_cast<double>(vertices)) : 0;
    }
    void operator+=(const Bending& other) {
        squares += other.squares;
        area += other.area;
        vertices += other.vertices;
    }
};

/// The equation of a patch, and its solution.
class Fairing {
public:
    using Points = Factorisation::Points;

    Fairing(const Patch& patch, Points positions);

    /// Solves the equation with as much of the continuity as the surroundings tell: the patch stays
    /// near the membrane, and every continuity changes it by no more than the one before. On a
    /// smooth surface, the changes decrease; noise and bad triangles add the more to them, the
    /// higher the derivatives are. Returns the continuity, or -1 if not even the membrane is found:
    /// then nothing moves.
    int solve(int continuity);
    const Points& positions() const { return positions_; }
    int passes() const { return made_; }
    /// Returns the largest distance from the membrane, relative to the size of the hole.
    double height() const {
        return std::sqrt((positions_ - membrane_).rowwise().squaredNorm().maxCoeff()) / size_;
    }

    /// Returns the bending of the patch, and of the second ring around it.
    std::pair<Bending, Bending> bending();

    /// Returns whether the surroundings turn so much from vertex to vertex that chance alone may
    /// have made the patch rise from its membrane as it does.
    bool is_rough(const Bending& inside, const Bending& around) const;

private:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// Moves the patch to its membrane in the metric of the given positions. Returns false if that
    /// fails.
    bool find_membrane();

    /// Solves the equation in the metric of the result. Returns false if there is no solution near
    /// the membrane.
    bool converge(int continuity);

    /// Takes the metric of the positions.
    void assemble(double thickening);

    /// Returns the rows of (L M⁻¹)^continuity L x for the vertices that move.
    Points product(int continuity, const Points& x) const;

    /// Returns the matrix of product() for the vertices that move, with their rows of L.
    Eigen::SparseMatrix<double> matrix(int continuity) const;

    /// Moves the vertices to the solution. Returns false if none is found. Mostly, the factors of
    /// the pass before suffice.
    bool step(int continuity);

    /// Moves the vertices to the solution by conjugate gradients, which the factors precondition.
    /// Returns false and moves none if the result is not good. The coordinates share the step
    /// lengths, so the result turns with the mesh.
    bool solve_with_factors(int continuity);

    /// Returns whether the patch is in the ball around its seam.
    bool is_in_hole() const;

    /// Returns the RMS distance of the vertices that move from other positions of them.
    double distance(const Points& others) const;

    /// Returns the RMS of the part of this distance along the normals of the triangles.
    double distance_along_normals(const Points& others) const;

    const Patch& patch_;
    Points positions_, membrane_;
    Eigen::RowVector3d centre_;  ///< of the hole
    double size_ = 0;            ///< diameter of the hole: see FairReport::height
    int made_ = 0;
    Matrix stiffness_;
    Eigen::VectorXd masses_, weights_;  ///< the weights are the diagonal of M⁻¹
    Factorisation factors_;
    bool is_factorised_ = false;
};

}  // namespace tracked_mcf
