// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/element_matrix.h"

namespace tracked_mcf {

/// Number of steps into which a cell's side is divided for the local coordinates of samples, at
/// most 2^21. The rounding error is at most 2.5e-7 of a side, close to that of single precision, in
/// two thirds of the memory. Thirds, fifths and 2^-17 of a side are exact, so a sample aligned with
/// the grid stays aligned.
inline constexpr int kSampleSteps = 15 << 17;

/// A sample's local coordinates are packed into two words. Word 0: x in bits 11 to 31, z's high
/// half below; word 1: y in bits 11 to 31, z's low half below.
inline constexpr int kPackedShift = 11;
inline constexpr int kPackedMask = (1 << kPackedShift) - 1;

/// Number of readable samples required behind the last one, because kernels read whole vectors.
inline constexpr std::int64_t kSamplePadding = 16;

/// The integrals' data of a fragment, the part of a triangle in a cell.
struct Fragment {
    float normal[3];            ///< unit normal of the initial triangle; 0 if degenerate
    std::int32_t sample_count;  ///< number of its samples, which are consecutive
};

/// All samples of a surface, sorted by fragment, and its fragments, sorted by element. Each array
/// of samples is followed by kSamplePadding readable numbers.
struct SampleArrays {
    const std::uint32_t* packed_local[2];  ///< local coordinates, see kPackedShift
    const float* weight;                   ///< w_p: area on the initial surface, grid units²
    const Fragment* fragments;
    const std::int64_t* sample_begin;    ///< first sample of each element, and the end
    const std::int64_t* fragment_begin;  ///< first fragment of each element, and the end
};

/// Greatest number of elements integrated in one call.
inline constexpr int kElementBatch = kBlockElements;

/// The input of the integrals over consecutive elements.
struct IntegrationInput {
    std::int64_t begin;            ///< first element, a multiple of kElementBatch
    std::int64_t end;              ///< at most begin + kElementBatch
    const std::int32_t* unknowns;  ///< eight for each element of the level
    const double* displacement;    ///< of the embedding X_t, three for each unknown, grid units
    SampleArrays samples;
    float step_size_in_squared_cells;  ///< δ, the weight of ∫ ∇B_I · ∇B_J; squared sides of a
                                       ///< finest cell
};

/// The output arrays, for all elements of the level. The kernel sets those from begin to end, and
/// sets the matrices of some lanes beyond the end to zero.
struct IntegrationOutput {
    MatrixBlock* matrices;
    MatrixBlock* stiffnesses;  ///< δ ∫ ∇B_I · ∇B_J alone, or null
    ElementVector* right_sides;
    float* areas;  ///< of the embedded surface in each element, grid units²
};

/// Integrates elements by their samples, see assemble_elements(). Returns the number of collapsed
/// samples.
std::int64_t integrate_elements(const IntegrationInput& input, const IntegrationOutput& output);

}  // namespace tracked_mcf
