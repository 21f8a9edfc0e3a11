// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/solver/part_blocks.h"
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
    /// `held` flags the held vertices, `parts` has the part of each vertex, see PartBlocks. Stars
    /// and flags must outlive this.
    MeshSystem(const Stars& stars, const std::vector<std::uint8_t>& held,
               const std::vector<std::int32_t>& parts);

    /// Takes mass and stiffness from linear elements, or the mass only: then the stiffness of the
    /// last call stays. A vertex keeps at least a small part of its first mass, so that one on a
    /// surface that has vanished stays where it is.
    void take(const TriangleElements& elements, double step_size, bool takes_stiffness = true);

    /// Computes product = factor * δ L x; 0 at held vertices. The differences of x, not x, are
    /// rounded to single precision.
    void multiply_stiffness(const std::vector<Eigen::Vector3d>& x, double factor,
                            Field& product) const;
    using Block = PartBlocks::Block;

    /// Computes the rows of a block of residual = b - A x in double precision; 0 at held vertices.
    void residual(const Block& block, const Field& b, const std::vector<Eigen::Vector3d>& x,
                  Field& residual) const;

    /// Sets the rows of a block of p = z + keep * p and q = A p, given q = A p before. Returns the
    /// product p · q of these rows.
    double advance(const Block& block, const Field& z, float keep, Field& p, Field& q) const;

    /// Computes the rows of a block of z = B r by an incomplete Cholesky factorisation of this
    /// block of A: B⁻¹ = (E + U)ᵀ E⁻¹ (E + U), where U is the block's upper triangle above the
    /// diagonal. The diagonal E makes that of B⁻¹ equal to that of A, or larger where E would
    /// otherwise not dominate U (Meijerink and van der Vorst, "An Iterative Solution Method for
    /// Linear Systems of Which the Coefficient Matrix is a Symmetric M-Matrix", 1977). Returns the
    /// product r · z of these rows.
    double relax(const Block& block, const Field& r, Field& z) const;

    /// A part of at most as many rows can be solved by solve().
    static constexpr std::int32_t kFewRows = 16;

    /// Solves A x = b for the rows of a block that is a whole part of a few rows, by a Cholesky
    /// factorisation in double precision; 0 at held vertices.
    void solve(const Block& block, const Field& b, std::vector<Eigen::Vector3d>& x) const;

    const PartBlocks& blocks() const { return blocks_; }

    const Stars& stars() const { return stars_; }
    bool is_held(std::int32_t vertex) const { return held_[vertex] != 0; }
    /// Returns the lumped mass of a vertex.
    float mass(std::int32_t vertex) const { return masses_[vertex]; }
    float step_size() const { return step_size_; }

private:
    /// A row of A, cut into groups of four entries: those of the row's block before the diagonal,
    /// those after it, and those of other blocks. Entries that fill a group up are 0. Groups are
    /// numbered, because a row never has more groups than neighbours, and Stars has fewer than 2^32
    /// of these.
    struct Row {
        std::uint32_t begin;  ///< the first group
        std::uint32_t lower;  ///< end of the groups before the diagonal
        std::uint32_t upper;  ///< end of the groups after it
    };

    void make_rows();
    /// Computes the pivots E, see relax(), of a block.
    void factorise(const Block& block);

    const Stars& stars_;
    const std::vector<std::uint8_t>& held_;
    const PartBlocks blocks_;
    float step_size_ = 0;
    RawVector<float> weights_;         ///< per entry of Stars::neighbours: -L
    RawVector<Row> rows_;              ///< per vertex, and one more, for its begin
    RawVector<std::int32_t> columns_;  ///< of the groups
    RawVector<float> entries_;         ///< of A, likewise
    RawVector<float> masses_;          ///< per vertex, lumped
    std::vector<float> least_masses_;  ///< per vertex
    RawVector<float> diagonal_;        ///< of A
    RawVector<float> inverse_pivots_;  ///< of E, see relax(); 0 for held vertices
};

}  // namespace tracked_mcf
