#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include "filter_tracked_mcf/core/kernels/element_products.h"
#include "filter_tracked_mcf/core/kernels/lanes.h"

// For element_products.cpp alone, see lanes.h.

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// What a field has for one unknown: x, y, z, and a zero.
using Column = float __attribute__((vector_size(16)));

/// One coordinate each, of one corner of as many elements as there are lanes.
struct Coordinates {
    Lanes of_axis[3];
};

/// Columns of as many elements: in the k-th of four variables those of every fourth element from
/// the k-th on.
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
/// All lanes. The instructions that take a mask are used for all, for GCC 12 takes what the headers
/// of the others leave undefined for a mistake.
constexpr __mmask16 kAll = 0xFFFF;
constexpr __mmask8 kAllOfColumn = 0xF;
#endif

/// The columns of every fourth element from the k-th on.
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

/// The columns in x of one corner of the elements whose unknowns these are.
TRACKED_MCF_INLINE Columns read_columns(const float* x, const std::int32_t* unknowns) {
    const auto column = [&](int lane) {
        return load_column(x + std::int64_t{4} * unknowns[8 * lane]);
    };
    return {{side_by_side(0, column), side_by_side(1, column), side_by_side(2, column),
             side_by_side(3, column)}};
}

/// The column of one of the elements.
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

/// Of four lanes at a time: the first of a, of b, the second of a, of b. Two further on, the
/// others.
constexpr LaneIndices kPairsInFours =
    (kLaneIndex & ~3) + (kLaneIndex & 2) / 2 + (kLaneIndex & 1) * kLanes;
/// Of four lanes at a time: the first two of a and of b. Two further on, the last two.
constexpr LaneIndices kHalvesInFours =
    (kLaneIndex & ~3) + (kLaneIndex & 1) + (kLaneIndex & 2) / 2 * kLanes;

TRACKED_MCF_INLINE Coordinates coordinates(const Columns& columns) {
    const Lanes(&c)[4] = columns.of_remainder;
    const Lanes xy_low = pick(c[0], c[1], kPairsInFours);
    const Lanes xy_high = pick(c[2], c[3], kPairsInFours);
    const Lanes z_low = pick(c[0], c[1], kPairsInFours + 2);
    const Lanes z_high = pick(c[2], c[3], kPairsInFours + 2);
    return {{pick(xy_low, xy_high, kHalvesInFours), pick(xy_low, xy_high, kHalvesInFours + 2),
             pick(z_low, z_high, kHalvesInFours)}};
}

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
