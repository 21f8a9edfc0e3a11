#pragma once

#include <cstdint>

// Plain structs only: the kernels include this (see kernels/kernels.h).

namespace tracked_mcf {

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
    const float* local[3];  ///< local coordinates in their cell, 0 to 1
    const float* weight;    ///< w_p: area that they stand for on the initial surface, grid units²
    const Fragment* fragments;
    const std::int64_t* sample_begin;    ///< of every element, and the end
    const std::int64_t* fragment_begin;  ///< of every element, and the end
};

}  // namespace tracked_mcf
