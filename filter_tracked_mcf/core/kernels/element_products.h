#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"

namespace tracked_mcf {

/// Consecutive elements of a level.
struct ElementRange {
    const ElementMatrix* matrices;  ///< of all the level's elements, symmetric
    const std::int32_t* unknowns;   ///< eight of each
    std::int32_t begin, end;
};

/// y += factor * Σ_e R_eᵀ M_e R_e x over the elements of the range, R_e picking an element's eight
/// unknowns and M_e its matrix; x and y have four floats for every unknown, 16-byte aligned.
using AddElementProducts = void(const ElementRange& range, float factor, const float* x, float* y);

/// The same with factor 1, and returns what that adds to x · y: Σ_e (R_e x) · M_e R_e x over the
/// range, all four columns together.
using AddElementProductsAndDot = double(const ElementRange& range, const float* x, float* y);

/// The entries of a symmetric matrix of an element, row by row from the diagonal on.
struct PackedMatrix {
    float entry[36];
};

/// Consecutive elements of a level with such matrices.
struct PackedElements {
    const PackedMatrix* matrices;
    const std::int32_t* unknowns;
    std::int32_t begin, end;
};

/// AddElementProducts with packed matrices.
using AddPackedProducts = void(const PackedElements& range, float factor, const float* x, float* y);

/// The same for element vectors.
struct ElementVectors {
    const ElementVector* vectors;
    const std::int32_t* unknowns;
    std::int32_t begin, end;
};

/// y += Σ_e R_eᵀ v_e over the range, v_e being an element's vector.
using AddElementVectors = void(const ElementVectors& range, float* y);

}  // namespace tracked_mcf
