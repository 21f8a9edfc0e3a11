// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The system of a step on the mesh's own linear elements: A = M + δ L. An unknown is a vertex.
///
/// M is half the lumped and half the consistent mass. Waves of a few edges then have the speed of
/// the continuous flow to fourth order in the edge length: lumped masses make them too slow,
/// consistent ones too fast, by the same amount. Numbers are single precision.
class MeshSystem {
public:
    /// `fixed` has a flag for each vertex that stays. Both must outlive this.
    MeshSystem(const Stars& stars, const std::vector<std::uint8_t>& fixed);

    /// Takes mass and stiffness from linear elements, or the mass only: then the stiffness of the
    /// last call stays. A vertex keeps at least a small part of its first mass, so that one on a
    /// surface that has vanished stays where it is.
    void take(const TriangleElements& elements, double step_size, bool takes_stiffness = true);

    /// Computes product = factor * δ L x; 0 at vertices that stay. The differences of x, not x, are
    /// rounded to single precision.
    void multiply_stiffness(const std::vector<Eigen::Vector3d>& x, double factor,
                            Field& product) const;
    /// Computes residual = b - A x in double precision; 0 at vertices that stay.
    void residual(const Field& b, const std::vector<Eigen::Vector3d>& x, Field& residual) const;

    /// Sets p = z + keep * p and q = A p, given q = A p before. Returns p · q.
    double advance(const Field& z, float keep, Field& p, Field& q) const;

    /// Computes rows `begin` to `end` of z = B r by an incomplete Cholesky factorisation of this
    /// block of A: B⁻¹ = (E + U)ᵀ E⁻¹ (E + U), where U is the block's upper triangle above the
    /// diagonal. The diagonal E makes that of B⁻¹ equal to that of A, or larger where E would
    /// otherwise not dominate U (Meijerink and van der Vorst, "An Iterative Solution Method for
    /// Linear Systems of Which the Coefficient Matrix is a Symmetric M-Matrix", 1977). The block is
    /// a chunk of rows. Returns the product r · z of these rows.
    double relax(std::int32_t begin, std::int32_t end, const Field& r, Field& z) const;

    const Stars& stars() const { return stars_; }
    bool is_fixed(std::int32_t vertex) const { return fixed_[vertex] != 0; }
    /// Returns the lumped mass of a vertex.
    float mass(std::int32_t vertex) const { return masses_[vertex]; }
    float step_size() const { return step_size_; }

private:
    /// A row of A, cut into groups of four entries: those of the row's chunk before the diagonal,
    /// those after it, and those of other chunks. Entries that fill a group up are 0.
    struct Row {
        std::uint32_t begin;  ///< of the first group
        std::uint32_t lower;  ///< end of the groups before the diagonal
        std::uint32_t upper;  ///< end of the groups after it
    };

    void make_rows();
    /// Computes the pivots E, see relax(), of a chunk of rows.
    void factorise(std::int32_t begin, std::int32_t end);

    const Stars& stars_;
    const std::vector<std::uint8_t>& fixed_;
    float step_size_ = 0;
    RawVector<float> weights_;         ///< per entry of Stars::neighbours: -L
    RawVector<Row> rows_;              ///< per vertex, and one more, for its begin
    RawVector<std::int32_t> columns_;  ///< of the groups
    RawVector<float> entries_;         ///< of A, likewise
    RawVector<float> masses_;          ///< per vertex, lumped
    std::vector<float> least_masses_;  ///< per vertex
    RawVector<float> diagonal_;        ///< of A
    RawVector<float> inverse_pivots_;  ///< of E, see relax(); 0 for vertices that stay
};

}  // namespace tracked_mcf
