#pragma once

#include <cstdint>

// Plain structs only: the kernels include this (see kernels/kernels.h).

namespace tracked_mcf {

/// A point at which the integrals of equation 4 are sampled.
struct Sample {
    float local[3];  ///< local coordinates in its cell, 0 to 1
    float weight;    ///< w_p: area it stands for on the initial surface, grid units²
};

/// The part of a triangle in a cell, as the integrals see it.
struct Fragment {
    float normal[3];            ///< unit normal of the initial triangle; 0 if degenerate
    std::int32_t sample_count;  ///< consecutive in TrackedElements::samples
};

}  // namespace tracked_mcf
