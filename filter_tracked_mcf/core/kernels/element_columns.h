// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include "filter_tracked_mcf/core/kernels/element_products.h"
#include "filter_tracked_mcf/core/kernels/lanes.h"

// Only element_products.cpp includes this, see lanes.h.

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// The column of a Field for one unknown: x, y, z and a zero.
using Column = float __attribute__((vector_size(16)));

/// The coordinates at one corner, one variable per coordinate and one lane per element.
struct Coordinates {
    Lanes of_axis[3];
};

/// The columns at one corner, for one element per lane. Variable k has the columns of the elements
/// k, k + 4, k + 8 and k + 12.
struct Columns {
    Lanes of_remainder[4];
};

TRACKED_MCF_INLINE Column load_column(const float* from) {
    Column column;
    __builtin_memcpy(&column, __builtin_assume_aligned(from, 16), sizeof column);
    return column;
}

TRACKED_MCF_INLINE void add_to(float* to, const Column& column) {
    const Column sum = load_column(to) + column;
    __builtin_memcpy(__builtin_assume_aligned(to, 16), &sum, sizeof sum);
}

#if defined(__AVX512F__)
/// Masks that select all lanes. GCC 12 warns of undefined values in the headers of the instructions
/// without a mask.
constexpr __mmask16 kAll = 0xFFFF;
constexpr __mmask8 kAllOfColumn = 0xF;
#endif

/// Returns the columns of the elements k, k + 4, k + 8, … side by side in one vector.
template <class ColumnOf>
TRACKED_MCF_INLINE Lanes side_by_side(int k, const ColumnOf& column) {
#if defined(__AVX512F__)
    Lanes lanes = _mm512_zextps128_ps512(column(k));
    lanes = _mm512_maskz_insertf32x4(kAll, lanes, column(k + 4), 1);
    lanes = _mm512_maskz_insertf32x4(kAll, lanes, column(k + 8), 2);
    return _mm512_maskz_insertf32x4(kAll, lanes, column(k + 12), 3);
#elif defined(__AVX__)
    return _mm256_insertf128_ps(_mm256_castps128_ps256(column(k)), column(k + 4), 1);
#else
    return column(k);
#endif
}

/// Reads from x the columns at one corner. unknowns[8 * lane] is the unknown of each element.
TRACKED_MCF_INLINE Columns read_columns(const float* x, const std::int32_t* unknowns) {
    const auto column = [&](int lane) {
        return load_column(x + std::int64_t{4} * unknowns[8 * lane]);
    };
    return {{side_by_side(0, column), side_by_side(1, column), side_by_side(2, column),
             side_by_side(3, column)}};
}

/// Returns the column of one element.
template <int kLane>
TRACKED_MCF_INLINE Column column_of(const Columns& columns) {
    const Lanes& lanes = columns.of_remainder[kLane % 4];
#if defined(__AVX512F__)
    return _mm512_maskz_extractf32x4_ps(kAllOfColumn, lanes, kLane / 4);
#elif defined(__AVX__)
    return _mm256_extractf128_ps(lanes, kLane / 4);
#else
    return lanes;
#endif
}

/// In each group of four lanes: a0 b0 a1 b1. Plus 2: a2 b2 a3 b3.
constexpr LaneIndices kPairsInFours =
    (kLaneIndex & ~3) + (kLaneIndex & 2) / 2 + (kLaneIndex & 1) * kLanes;
/// In each group of four lanes: a0 a1 b0 b1. Plus 2: a2 a3 b2 b3.
constexpr LaneIndices kHalvesInFours =
    (kLaneIndex & ~3) + (kLaneIndex & 1) + (kLaneIndex & 2) / 2 * kLanes;

/// Transposes columns to coordinates.
TRACKED_MCF_INLINE Coordinates coordinates(const Columns& columns) {
    const Lanes(&c)[4] = columns.of_remainder;
    const Lanes xy_low = pick(c[0], c[1], kPairsInFours);
    const Lanes xy_high = pick(c[2], c[3], kPairsInFours);
    const Lanes z_low = pick(c[0], c[1], kPairsInFours + 2);
    const Lanes z_high = pick(c[2], c[3], kPairsInFours + 2);
    return {{pick(xy_low, xy_high, kHalvesInFours), pick(xy_low, xy_high, kHalvesInFours + 2),
             pick(z_low, z_high, kHalvesInFours)}};
}

/// Transposes coordinates to columns.
TRACKED_MCF_INLINE Columns columns_of(const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes zero = {};
    const Lanes xy_low = pick(x, y, kPairsInFours);
    const Lanes xy_high = pick(x, y, kPairsInFours + 2);
    const Lanes z_low = pick(z, zero, kPairsInFours);
    const Lanes z_high = pick(z, zero, kPairsInFours + 2);
    return {{pick(xy_low, z_low, kHalvesInFours), pick(xy_low, z_low, kHalvesInFours + 2),
             pick(xy_high, z_high, kHalvesInFours), pick(xy_high, z_high, kHalvesInFours + 2)}};
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
