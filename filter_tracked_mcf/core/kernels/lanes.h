#pragma once

// For the sources of kernels alone, see kernel_table.h: everything is internal to the file that
// includes it.

/// A helper of a kernel: never a symbol.
#define TRACKED_MCF_INLINE static inline __attribute__((always_inline))

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// How many floats an instruction works on.
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

/// Lanes of a, which have the indices from 0 on, and b, from kLanes on. The indices must be
/// constant; then both compilers make one instruction of it.
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

/// Of four lanes at a time: the even ones of a and b, to which the odd ones follow.
constexpr LaneIndices kEvenInFours =
    (kLaneIndex & ~3) + 2 * (kLaneIndex & 1) + (kLaneIndex & 2) / 2 * kLanes;
/// The even fours of a and then those of b, to which the odd ones follow.
constexpr LaneIndices kEvenFours = 2 * (kLaneIndex & ~3) + (kLaneIndex & 3);

/// Adds up the lanes of `kCount` variables, a power of two up to kLanes. With kLanes of them, the
/// sum of variable v ends in lane v.
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

/// Rows become columns. First exchanges blocks of kStride lanes between rows that far apart.
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
