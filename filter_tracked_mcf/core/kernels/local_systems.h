#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"

namespace tracked_mcf {

/// The couplings of an unknown, summed over the elements: its diagonal entry of the assembled
/// matrix, then those with the functions at the thirteen corners around its own that come after it
/// in lexicographic order, z slowest; the rest is padding.
struct Couplings {
    alignas(64) float sum[16];
};

/// Consecutive elements of a level, and what is summed over them.
struct CoupledElements {
    const std::int32_t* unknowns;  ///< eight of each
    /// Of every element, bit kCouplingPlaces.bit[i][j]: that entry of its matrix is not to be mixed
    /// with what other elements have at the same two corners, where two sheets have parted.
    const std::uint32_t* apart;
    std::int32_t begin, end;
};

/// Adds the entries of the elements' matrices to the couplings of their unknowns.
using SumCouplings = void(const CoupledElements& range, const MatrixBlock* matrices,
                          Couplings* couplings);

/// The inverse of an element is shares[e] * A_e⁻¹, for the elements of the range, which goes from a
/// multiple of kBlockElements to another or the level's last, A_e being the assembled matrix
/// restricted to the element's unknowns. Rows that are zero, or depend on those before, are left
/// out, and zero in the inverse.
using InvertLocally = void(const CoupledElements& range, const MatrixBlock* matrices,
                           const Couplings* couplings, const float* shares, MatrixBlock* inverses);

}  // namespace tracked_mcf
