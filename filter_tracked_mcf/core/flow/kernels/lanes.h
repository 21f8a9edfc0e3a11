// SPDX-License-Identifier: GPL-3.0-or-later

// Only the sources of kernels include this, see kernels.h. Everything here is internal to the file
// that includes it, and to one instruction set: the guard lets Highway include it once for each.
#if defined(TRACKED_MCF_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACKED_MCF_LANES_H
#undef TRACKED_MCF_LANES_H
#else
#define TRACKED_MCF_LANES_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Highway's tags of vectors: of floats, of as many words, and of half as many doubles.
constexpr hn::CappedTag<float, 8> kFloats;
constexpr hn::RebindToUnsigned<decltype(kFloats)> kWords;
constexpr hn::Repartition<double, decltype(kFloats)> kDoubles;

/// Number of floats in a vector: 4 or 8.
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kFloats));

using Lanes = hn::Vec<decltype(kFloats)>;
using Words = hn::Vec<decltype(kWords)>;

static HWY_INLINE Lanes load(const float* from) {
    return hn::LoadU(kFloats, from);
}
static HWY_INLINE void store(const Lanes& lanes, float* to) {
    hn::StoreU(lanes, kFloats, to);
}
static HWY_INLINE Lanes splat(float value) {
    return hn::Set(kFloats, value);
}
static HWY_INLINE Lanes zero() {
    return hn::Zero(kFloats);
}
/// Sets lanes to zero. `= {}` does not, on ARM.
template <int kCount>
static HWY_INLINE void set_zero(Lanes (&lanes)[kCount]) {
    for (Lanes& of_one : lanes) of_one = zero();
}

// Highway's shuffles work within blocks of four lanes, or move such blocks.

/// In each block: a0 a1 b0 b1.
static HWY_INLINE Lanes low_halves(const Lanes& a, const Lanes& b) {
    return hn::BitCast(
        kFloats, hn::InterleaveLower(kDoubles, hn::BitCast(kDoubles, a), hn::BitCast(kDoubles, b)));
}
/// In each block: a2 a3 b2 b3.
static HWY_INLINE Lanes high_halves(const Lanes& a, const Lanes& b) {
    return hn::BitCast(
        kFloats, hn::InterleaveUpper(kDoubles, hn::BitCast(kDoubles, a), hn::BitCast(kDoubles, b)));
}

/// In each block: a0+a1 b0+b1 a2+a3 b2+b3.
static HWY_INLINE Lanes sums_of_pairs(const Lanes& a, const Lanes& b) {
    return hn::OddEven(b, a) + hn::Shuffle2301(hn::OddEven(a, b));
}
/// In each block, lane v is the sum of variable v's lanes.
static HWY_INLINE Lanes sums_in_blocks(const Lanes* variables) {
    const Lanes low = sums_of_pairs(variables[0], variables[1]);
    const Lanes high = sums_of_pairs(variables[2], variables[3]);
    return low_halves(low, high) + high_halves(low, high);
}
/// The lower halves of a and b, plus the upper ones.
static HWY_INLINE Lanes sums_of_halves(const Lanes& a, const Lanes& b) {
    return hn::ConcatLowerLower(kFloats, b, a) + hn::ConcatUpperUpper(kFloats, b, a);
}

/// Sums the lanes of each of kLanes variables. Lane v of the result is the sum of variable v.
static HWY_INLINE Lanes sums_of_lanes(const Lanes* variables) {
    if constexpr (kLanes == 4) {
        return sums_in_blocks(variables);
    } else {
        return sums_of_halves(sums_in_blocks(variables), sums_in_blocks(variables + 4));
    }
}

/// Transposes four rows within each block.
static HWY_INLINE void transpose_in_blocks(Lanes* rows) {
    const Lanes low01 = hn::InterleaveLower(kFloats, rows[0], rows[1]);
    const Lanes low23 = hn::InterleaveLower(kFloats, rows[2], rows[3]);
    const Lanes high01 = hn::InterleaveUpper(kFloats, rows[0], rows[1]);
    const Lanes high23 = hn::InterleaveUpper(kFloats, rows[2], rows[3]);
    rows[0] = low_halves(low01, low23);
    rows[1] = high_halves(low01, low23);
    rows[2] = low_halves(high01, high23);
    rows[3] = high_halves(high01, high23);
}
/// Exchanges a's upper half and b's lower half.
static HWY_INLINE void exchange_halves(Lanes& a, Lanes& b) {
    const Lanes lower = hn::ConcatLowerLower(kFloats, b, a);
    b = hn::ConcatUpperUpper(kFloats, b, a);
    a = lower;
}

/// Transposes a square matrix of rows.
static HWY_INLINE void transpose(Lanes (&rows)[kLanes]) {
    for (int i = 0; i < kLanes; i += 4) transpose_in_blocks(rows + i);
    if constexpr (kLanes == 8) {
        for (int i = 0; i < 4; ++i) exchange_halves(rows[i], rows[i + 4]);
    }
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
