// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Only the sources of kernels include this, see kernels.h. Everything here is internal to the
// file that includes it.

/// Declares a helper of a kernel that never becomes a symbol.
#define TRACKED_MCF_INLINE static inline __attribute__((always_inline))

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// Number of floats in a vector register.
#if defined(__AVX512F__)
constexpr int kLanes = 16;
#elif defined(__AVX__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneIndices = int __attribute__((vector_size(kLanes * sizeof(int))));

/// 0, 1, 2, ...
#if defined(__AVX512F__)
constexpr LaneIndices kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#elif defined(__AVX__)
constexpr LaneIndices kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7};
#else
constexpr LaneIndices kLaneIndex = {0, 1, 2, 3};
#endif

TRACKED_MCF_INLINE Lanes load(const float* from) {
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}
TRACKED_MCF_INLINE LaneIndices load(const unsigned* from) {
    LaneIndices lanes;
    __builtin_memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}
TRACKED_MCF_INLINE Lanes to_floats(const LaneIndices& numbers) {
    return __builtin_convertvector(numbers, Lanes);
}
TRACKED_MCF_INLINE void store(const Lanes& lanes, float* to) {
    __builtin_memcpy(to, &lanes, sizeof(lanes));
}
TRACKED_MCF_INLINE Lanes splat(float value) {
    return value - Lanes{};
}

TRACKED_MCF_INLINE Lanes square_root(const Lanes& lanes) {
    Lanes roots;
    for (int lane = 0; lane < kLanes; ++lane) roots[lane] = __builtin_sqrtf(lanes[lane]);
    return roots;
}

/// Picks lanes of a by indices below kLanes, and lanes of b by the indices from kLanes on. With
/// constant indices, GCC and Clang compile this to one or a few shuffles.
TRACKED_MCF_INLINE Lanes pick(const Lanes& a, const Lanes& b, const LaneIndices& indices) {
#ifdef __clang__
    Lanes picked;
    for (int lane = 0; lane < kLanes; ++lane) {
        picked[lane] = indices[lane] < kLanes ? a[indices[lane]] : b[indices[lane] - kLanes];
    }
    return picked;
#else
    return __builtin_shuffle(a, b, indices);
#endif
}

/// In each group of four lanes: the even lanes of a, then those of b. Plus 1: the odd lanes.
constexpr LaneIndices kEvenInFours =
    (kLaneIndex & ~3) + 2 * (kLaneIndex & 1) + (kLaneIndex & 2) / 2 * kLanes;
/// The even groups of four lanes of a, then those of b. Plus 4: the odd groups.
constexpr LaneIndices kEvenFours = 2 * (kLaneIndex & ~3) + (kLaneIndex & 3);

/// Sums the lanes of each of `kCount` variables, a power of two up to kLanes. If kCount is kLanes,
/// lane v of the result is the sum of variable v.
template <int kCount>
TRACKED_MCF_INLINE Lanes sums_of_lanes(const Lanes* variables) {
    if constexpr (kCount == 1) {
        return variables[0];
    } else {
        const Lanes a = sums_of_lanes<kCount / 2>(variables);
        const Lanes b = sums_of_lanes<kCount / 2>(variables + kCount / 2);
        if constexpr (kCount <= 4) {
            return pick(a, b, kEvenInFours) + pick(a, b, kEvenInFours + 1);
        } else {
            return pick(a, b, kEvenFours) + pick(a, b, kEvenFours + 4);
        }
    }
}

/// Transposes a square matrix of rows. First exchanges blocks of kStride lanes between rows at a
/// distance of kStride.
template <int kStride = kLanes / 2>
TRACKED_MCF_INLINE void transpose(Lanes (&rows)[kLanes]) {
    constexpr LaneIndices first =
        kLaneIndex + (kLaneIndex & kStride) / kStride * (kLanes - kStride);
    for (int i = 0; i < kLanes; ++i) {
        if ((i & kStride) != 0) continue;
        const Lanes a = rows[i];
        const Lanes b = rows[i + kStride];
        rows[i] = pick(a, b, first);
        rows[i + kStride] = pick(a, b, first + kStride);
    }
    if constexpr (kStride > 1) transpose<kStride / 2>(rows);
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
