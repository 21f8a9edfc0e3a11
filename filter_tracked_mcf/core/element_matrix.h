#pragma once

#include <cstdint>

// Plain structs only: the kernels include this (see kernels/kernels.h).

namespace tracked_mcf {

/// The matrix of one element: a row and a column for each of its cell's eight functions. Symmetric.
struct ElementMatrix {
    alignas(32) float entry[8][8];
};

/// The displacement system's right side of one element: for each coordinate the eight functions'.
struct ElementVector {
    alignas(32) float entry[3][8];
};

/// Samples whose deformed area is at most this fraction of their initial area have collapsed: the
/// surface there has become a thread or a point and its metric means nothing. They contribute
/// nothing (section 5.1). Not so in a conformalized flow, where the stiffness is that of the
/// initial metric and nothing is divided by an area.
inline constexpr float kCollapsedAreaRatio = 1e-4F;

/// What has collapsed of one element: of each function ∫ B_I² over that part of the initial
/// surface.
struct Collapse {
    std::int32_t element;
    std::int32_t samples;
    float mass[8];
};

}  // namespace tracked_mcf
