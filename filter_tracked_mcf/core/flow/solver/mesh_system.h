// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/elimination.h"
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

    /// Computes the rows of a block of residual = b / unit - A x in double precision; 0 at held
    /// vertices. The unit is a power of two.
    void residual(const Block& block, const Field& b, double unit,
                  const std::vector<Eigen::Vector3d>& x, Field& residual) const;

    using Rows = Elimination::Rows;

    /// Solves (E + U)ᵀ z = r for these rows, given those that are eliminated before. Returns what
    /// they add to r · B r.
    ///
    /// B⁻¹ = (E + U)ᵀ E⁻¹ (E + U) is the incomplete Cholesky factorisation without fill, in the
    /// order of elimination(), of A with its positive entries moved to the diagonal. That is an
    /// M-matrix, for which E is positive (Meijerink and van der Vorst, "An Iterative Solution
    /// Method for Linear Systems of Which the Coefficient Matrix is a Symmetric M-Matrix", 1977).
    double solve_lower(Rows rows, const Field& r, Field& z) const;
    /// Computes these rows of z = B r from what solve_lower() gives, and from the rows that are
    /// eliminated after them.
    void solve_upper(Rows rows, Field& z) const;

    /// Where conjugate gradients are.
    struct Search {
        bool is_first = true;  ///< then x, p and q count as 0
        float step = 0;        ///< along the last direction
        float beta = 0;        ///< how much of the last direction is in the next one
    };
    /// Computes these rows of x += step * p, p = z + beta * p and q = A p, given q = A p before.
    /// Returns the product p · q of these rows.
    double advance(Rows rows, const Search& search, const Field& z, Field& x, Field& p,
                   Field& q) const;

    /// A part of at most as many rows can be solved by solve().
    static constexpr std::int32_t kFewRows = 16;

    /// Solves A x = b / unit for the rows of a block that is a whole part of a few rows, by a
    /// Cholesky factorisation in double precision; 0 at held vertices.
    void solve(const Block& block, const Field& b, double unit,
               std::vector<Eigen::Vector3d>& x) const;

    const PartBlocks& blocks() const { return blocks_; }
    const Elimination& elimination() const { return elimination_; }

    const Stars& stars() const { return stars_; }
    bool is_held(std::int32_t vertex) const { return held_[vertex] != 0; }
    /// Returns the lumped mass of a vertex.
    float mass(std::int32_t vertex) const { return masses_[vertex]; }
    float step_size() const { return step_size_; }

private:
    /// A row of A, cut into groups of four entries: those of neighbours that are eliminated before
    /// it, in their order, and the others. Entries that fill a group up are 0, and have the row's
    /// own column. Groups are numbered, because a row never has more groups than neighbours, and
    /// Stars has fewer than 2^32 of these.
    struct Row {
        std::uint32_t begin;  ///< the first group
        std::uint32_t lower;  ///< end of the groups of those before
    };

    void make_rows();
    /// Takes a row of A. `mass_entries` is workspace.
    void take_row(const TriangleElements& elements, bool takes_stiffness, std::int32_t row,
                  std::vector<float>& mass_entries);
    /// Returns the entry of a row with one that is eliminated before it, or the end of these
    /// entries.
    std::size_t lower_entry(std::int32_t row, std::int32_t column) const;
    /// Computes E of these rows, and their entries of U before the diagonal.
    void factorise(Rows rows);
    /// Copies a block's other entries of U from where factorise() has computed them.
    void mirror_factors(const Block& block);

    const Stars& stars_;
    const std::vector<std::uint8_t>& held_;
    const PartBlocks blocks_;
    const Elimination elimination_;
    float step_size_ = 0;
    RawVector<float> weights_;         ///< per entry of Stars::neighbours: -L
    RawVector<Row> rows_;              ///< per vertex, and one more, for its begin
    RawVector<std::int32_t> columns_;  ///< of the groups
    RawVector<float> entries_;         ///< of A, likewise
    RawVector<float> factors_;         ///< of U, see solve_lower(), likewise
    RawVector<float> masses_;          ///< per vertex, lumped
    std::vector<float> least_masses_;  ///< per vertex
    RawVector<float> diagonal_;        ///< of A
    RawVector<float> inverse_pivots_;  ///< of E; 0 for held vertices
};

}  // namespace tracked_mcf
