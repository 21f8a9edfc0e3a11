// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// Mass and stiffness of linear elements on a surface, and the systems of a step.
///
/// The metric is that of (X, s N), where N are normals and every side of X counts as one edge: the
/// square of a side is 1 + s² |ΔN|². A crease, across which N turns, is wide. The lengths of the
/// noisy surface itself are of no use: noise makes them longer, so the noisiest parts would be
/// smoothed least. Only the stiffness for positions takes a part of the squared lengths along the
/// surface, so that a vertex follows its near neighbours more than its far ones.
///
/// At the vertices of a rim, L X also holds the flux through the rim: the integral of the test
/// function times the derivative of X along the conormal. For a flat sheet this is the conormal,
/// which is no curvature, and which would shrink the sheet.
class LinearElements {
public:
    /// `surface` must outlive the elements.
    explicit LinearElements(const NoisySurface& surface);

    /// Takes the metric of normals N and the length s, in edges, and of `positions` if there are
    /// any, and the flux of these, for systems with the step size δ. A triangle that is far stiffer
    /// than others is made softer.
    void assemble(const Vectors& normals, double normal_length, double step_size,
                  const Positions* positions = nullptr);

    /// Solves (M + δ L) x = M b, from the given x, so far that the error is about `reduction` times
    /// what it was. Returns the number of iterations.
    int smooth(const Vectors& b, double reduction, Vectors& x);

    /// Does the same in the metric with s = 0, where every side is an edge long. Needs no assembly.
    int smooth_evenly(double step_size, const Vectors& b, double reduction, Vectors& x);

    /// Finds the displacements d that solve (F M + δ² L M⁻¹ L) d = -δ² L M⁻¹ (L X - f), where F are
    /// the fidelities, f is the flux at right angles to `normals`, and vertices without a fidelity
    /// stay: a wave with the eigenvalue k keeps 1 / (1 + (δ k)²) where F is 1. The elements must
    /// have the metric of `positions`. Returns the number of iterations.
    /// The fourth component of d is what becomes of `heights` in the same way, if there are any.
    int displace(const Positions& positions, const Vectors& normals,
                 const std::vector<float>& heights, Vectors& d);

    /// Returns a bound of the eigenvalues of δ M⁻¹ L.
    double largest_eigenvalue() const { return largest_eigenvalue_; }
    /// Returns row `vertex` of δ M⁻¹ L x.
    Eigen::Vector4f curvature(const Vectors& x, std::int32_t vertex) const {
        return delta_ / masses_[vertex] * stiffness(x, vertex);
    }

private:
    void find_curvatures(const Positions& positions, const Vectors& normals,
                         const std::vector<float>& heights, Vectors& curvatures) const;
    int displace_by_series(Vectors& d);
    int displace_by_conjugate_gradients(Vectors& d);
    Eigen::Vector4f stiffness(const Vectors& x, std::int32_t vertex) const;
    template <class Jacobi>
    int accelerate(const Jacobi& jacobi, double low, double high, double reduction, Vectors& x);

    const NoisySurface& surface_;
    float delta_ = 0;
    TriangleElements triangles_;
    RawVector<float> values_;             ///< per entry of Stars::neighbours: -L
    RawVector<float> masses_, diagonal_;  ///< of M and of L
    double largest_eigenvalue_ = 0;
    Vectors flux_;              ///< per vertex; empty without a rim
    RawVector<float> inverse_;  ///< the preconditioner: of a diagonal, or 0
    Vectors residual_, direction_, product_, inner_;
};

}  // namespace tracked_mcf
