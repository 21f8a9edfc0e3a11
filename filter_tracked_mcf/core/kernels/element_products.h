#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"

namespace tracked_mcf {

/// Consecutive elements of a level, from a multiple of kBlockElements to another or the level's
/// last, and where what they add goes.
struct ElementRange {
    /// Of elements that all add to their unknowns straight away.
    static constexpr std::int64_t kStraight = -1;

    const std::int32_t* unknowns;  ///< eight of each of the level's elements
    /// Of every kBlockElements of the level: kStraight, or where their targets begin, eight of each
    /// element, one element after the other. A target is an unknown, or -1 - a slot, to add to
    /// instead of an unknown.
    const std::int64_t* detours;
    const std::int32_t* targets;
    float* slots;  ///< four floats each
    std::int32_t begin, end;
};

/// y += factor * Σ_e R_eᵀ M_e R_e x over the elements of the range, R_e picking an element's eight
/// unknowns and M_e its matrix, `matrices` being the blocks of all of the level's; x and y have
/// four floats for every unknown, 16-byte aligned, the last of them zero.
using AddElementProducts = void(const ElementRange& range, const MatrixBlock* matrices,
                                float factor, const float* x, float* y);

/// The same with factor 1. Returns what it adds to x · y: Σ_e (R_e x) · M_e R_e x.
using AddElementProductsAndDot = double(const ElementRange& range, const MatrixBlock* matrices,
                                        const float* x, float* y);

/// y += Σ_e R_eᵀ v_e over the elements of the range, v_e being an element's vector.
using AddElementVectors = void(const ElementRange& range, const ElementVector* vectors, float* y);

}  // namespace tracked_mcf
