// SPDX-License-Identifier: GPL-3.0-or-later

// Only element_products.cpp includes this, see lanes.h.
#if defined(TRACKED_MCF_ELEMENT_COLUMNS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACKED_MCF_ELEMENT_COLUMNS_H
#undef TRACKED_MCF_ELEMENT_COLUMNS_H
#else
#define TRACKED_MCF_ELEMENT_COLUMNS_H
#endif

#include "filter_tracked_mcf/core/flow/kernels/element_products.h"
#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

/// The column of a Field for one unknown: x, y, z and a zero.
constexpr hn::CappedTag<float, 4> kColumn;
using Column = hn::Vec<decltype(kColumn)>;

/// The coordinates at one corner, one variable per coordinate and one lane per element.
struct Coordinates {
    Lanes of_axis[3];
};

/// The columns at one corner, for one element per lane. Variable k has the columns of the elements
/// k, k + 4, k + 8 and k + 12.
struct Columns {
    Lanes of_remainder[4];
};

static HWY_INLINE void add_to(float* to, const Column& column) {
    hn::Store(hn::Load(kColumn, to) + column, kColumn, to);
}

/// Returns the columns of the elements k, k + 4, k + 8, … side by side in one vector.
template <class Tag, class ColumnOf>
static HWY_INLINE hn::Vec<Tag> side_by_side(Tag tag, int k, const ColumnOf& column) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        return column(k);
    } else {
        const hn::Half<Tag> half;
        const int upper = k + static_cast<int>(hn::MaxLanes(half));
        return hn::Combine(tag, side_by_side(half, upper, column), side_by_side(half, k, column));
    }
}

/// Reads from x the columns at one corner. unknowns[8 * lane] is the unknown of each element.
static HWY_INLINE Columns read_columns(const float* x, const std::int32_t* unknowns) {
    const auto column = [&](int lane) HWY_ATTR {
        return hn::Load(kColumn, x + std::int64_t{4} * unknowns[8 * lane]);
    };
    return {{side_by_side(kFloats, 0, column), side_by_side(kFloats, 1, column),
             side_by_side(kFloats, 2, column), side_by_side(kFloats, 3, column)}};
}

/// Returns four consecutive lanes.
template <int kBlock, class Tag>
static HWY_INLINE Column block_of(Tag tag, const hn::Vec<Tag>& lanes) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        return lanes;
    } else {
        const hn::Half<Tag> half;
        constexpr int blocks = static_cast<int>(hn::MaxLanes(half)) / 4;
        if constexpr (kBlock < blocks) {
            return block_of<kBlock>(half, hn::LowerHalf(half, lanes));
        } else {
            return block_of<kBlock - blocks>(half, hn::UpperHalf(half, lanes));
        }
    }
}

/// Returns the column of one element.
template <int kLane>
static HWY_INLINE Column column_of(const Columns& columns) {
    return block_of<kLane / 4>(kFloats, columns.of_remainder[kLane % 4]);
}

/// Transposes columns to coordinates.
static HWY_INLINE Coordinates coordinates(const Columns& columns) {
    const Lanes(&c)[4] = columns.of_remainder;
    const Lanes xy_low = hn::InterleaveLower(kFloats, c[0], c[1]);
    const Lanes xy_high = hn::InterleaveLower(kFloats, c[2], c[3]);
    const Lanes z_low = hn::InterleaveUpper(kFloats, c[0], c[1]);
    const Lanes z_high = hn::InterleaveUpper(kFloats, c[2], c[3]);
    return {{low_halves(xy_low, xy_high), high_halves(xy_low, xy_high), low_halves(z_low, z_high)}};
}

/// Transposes coordinates to columns.
static HWY_INLINE Columns columns_of(const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes xy_low = hn::InterleaveLower(kFloats, x, y);
    const Lanes xy_high = hn::InterleaveUpper(kFloats, x, y);
    const Lanes z_low = hn::InterleaveLower(kFloats, z, zero());
    const Lanes z_high = hn::InterleaveUpper(kFloats, z, zero());
    return {{low_halves(xy_low, z_low), high_halves(xy_low, z_low), low_halves(xy_high, z_high),
             high_halves(xy_high, z_high)}};
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
