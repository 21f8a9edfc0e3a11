#pragma once

#include <cstdint>

// Plain structs and constants only: the kernels include this (see kernels/kernel_table.h).

namespace tracked_mcf {

/// Into how many steps a cell's side is divided for the coordinates of samples, which then are up
/// to 2.5e-7 of a cell off, not far from what single precision would make of them, in two thirds of
/// the room. Thirds, fifths and halves to the seventeenth are exact, so that what is aligned with
/// the grid stays so. At most 2^21.
inline constexpr int kSampleSteps = 15 << 17;

/// Where a sample lies in its cell: 21 bits of x and 11 of z, 21 of y and 11 of z, each from the
/// highest on, and of z the higher ones first.
inline constexpr int kPlaceShift = 11;
inline constexpr int kPlaceMask = (1 << kPlaceShift) - 1;

/// Kernels read whole vectors of samples.
inline constexpr std::int64_t kSamplePadding = 16;

/// The part of a triangle in a cell, as the integrals see it.
struct Fragment {
    float normal[3];            ///< unit normal of the initial triangle; 0 if degenerate
    std::int32_t sample_count;  ///< consecutive in Samples
};

/// All samples of a surface, sorted by fragment, and fragments, sorted by element. Behind the
/// samples there are further readable numbers, kSamplePadding of them in each array.
struct SampleArrays {
    const std::uint32_t* places[2];  ///< where they lie in their cell, see kPlaceShift
    const float* weight;  ///< w_p: area that they stand for on the initial surface, grid units²
    const Fragment* fragments;
    const std::int64_t* sample_begin;    ///< of every element, and the end
    const std::int64_t* fragment_begin;  ///< of every element, and the end
};

}  // namespace tracked_mcf
