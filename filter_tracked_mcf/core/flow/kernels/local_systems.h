// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/element_matrix.h"

namespace tracked_mcf {

/// The couplings of an unknown, summed over all elements. sum[0] is its diagonal entry in the
/// assembled matrix. sum[1] to sum[13] are its entries with the functions at the neighbouring
/// corners that follow its own in lexicographic order, z slowest. The rest is padding.
struct Couplings {
    alignas(64) float sum[16];
};

/// The index, in the Couplings of the smaller of the corners i and j of a cell, of the entry
/// between their functions.
struct CouplingIndices {
    std::uint8_t of[8][8];
    std::uint8_t bit[8][8];  ///< number of the pair, for (i, j) and (j, i); 31 if i is j
};

constexpr CouplingIndices make_coupling_indices() {
    CouplingIndices indices{};
    std::uint8_t pairs = 0;
    for (int i = 0; i < 8; ++i) {
        indices.bit[i][i] = 31;
        for (int j = i + 1; j < 8; ++j) {
            // The lexicographic offset from corner i to j, one of -13 to 13. It is positive: the
            // highest bit in which i and j differ is set in j, the larger number.
            int offset = 0;
            for (int axis = 2; axis >= 0; --axis) {
                offset = 3 * offset + ((j >> axis) & 1) - ((i >> axis) & 1);
            }
            indices.of[i][j] = indices.of[j][i] = static_cast<std::uint8_t>(offset);
            indices.bit[i][j] = indices.bit[j][i] = pairs++;
        }
    }
    return indices;
}

constexpr CouplingIndices kCouplingIndices = make_coupling_indices();

/// Consecutive elements of a level with the unknowns that they couple.
struct CoupledElements {
    const std::int32_t* unknowns;  ///< eight for each element of the level
    /// For each element a mask of entries. Bit kCouplingIndices.bit[i][j] marks an entry (i, j)
    /// without a place: that in Couplings belongs to another pair of unknowns, on another sheet.
    const std::uint32_t* without_place;
    std::int32_t begin, end;
};

/// Adds the entries of the elements' matrices, except those without a place, to the couplings of
/// their unknowns.
void sum_couplings(const CoupledElements& range, const MatrixBlock* matrices, Couplings* couplings);

/// Sets the inverse of each element e to damping[e] * A_e⁻¹. A_e is the assembled matrix restricted
/// to the element's unknowns, with the element's own value for entries without a place. Rows of A_e
/// that are zero, or depend on the rows before them, are left out, and are zero in the inverse. The
/// range goes from a multiple of kBlockElements to another one, or to the number of elements.
void invert_locally(const CoupledElements& range, const MatrixBlock* matrices,
                    const Couplings* couplings, const float* damping, MatrixBlock* inverses);

}  // namespace tracked_mcf
