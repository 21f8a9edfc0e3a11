// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/element_products.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/flow/kernels/element_products.cpp"
#include "filter_tracked_mcf/core/flow/kernels/targets.h"

#include <hwy/cache_control.h>

#include "filter_tracked_mcf/core/flow/kernels/element_columns.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

namespace {

/// [axis][corner]: one coordinate at one corner, for as many elements as there are lanes.
using CornerLanes = Lanes[3][8];

/// A block of a range's elements.
struct Block {
    const MatrixBlock* matrices;
    const MatrixBlock* later;      ///< the matrices to prefetch
    const std::int32_t* unknowns;  ///< eight for each of kBlockElements elements
    const std::int32_t* targets;   ///< eight for each of `count` elements
    int count;                     ///< number of elements, less than kBlockElements in a last block
    bool direct;                   ///< the targets are the unknowns
};

/// The unknowns of an incomplete last block, padded: any unknown will do where the matrix is zero.
using Padding = std::int32_t[8 * kBlockElements];

static HWY_INLINE Block block_at(const ElementRange& range, const MatrixBlock* matrices,
                                 std::int32_t first, Padding& padding) {
    const std::int32_t left = range.end - first;
    const std::int64_t offset = range.target_offsets[first / kBlockElements];
    const bool direct = offset == ElementRange::kDirect;
    const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * first;
    const MatrixBlock* const here = matrices + first / kBlockElements;
    Block block = {here,
                   left > 2 * kBlockElements ? here + 2 : here,
                   unknowns,
                   direct ? unknowns : range.targets + offset,
                   left < kBlockElements ? left : kBlockElements,
                   direct};
    if (left < kBlockElements) {
        for (int i = 0; i < 8 * kBlockElements; ++i) {
            padding[i] = unknowns[i < 8 * left ? i : 0];
        }
        block.unknowns = padding;
    }
    return block;
}

/// Prefetches every `step`-th entry of a block, from `first` on. The work on one block takes longer
/// than the distance at which processors prefetch on their own.
static HWY_INLINE void prefetch(const MatrixBlock& block, int first, int step) {
    for (int entry = first; entry < kMatrixEntries; entry += step) {
        hwy::Prefetch(block.entry[entry]);
    }
}

static HWY_INLINE void read_corners(const float* x, const Block& block, int lane,
                                    CornerLanes& corners) {
    constexpr int step = 8 * kBlockElements / kLanes;
    HWY_UNROLL(8)
    for (int corner = 0; corner < 8; ++corner) {
        prefetch(*block.later, 8 * (lane / kLanes) + corner, step);
        const Coordinates c = coordinates(read_columns(x, block.unknowns + 8 * lane + corner));
        for (int axis = 0; axis < 3; ++axis) corners[axis][corner] = c.of_axis[axis];
    }
}

/// Computes products = factor * M x for the elements whose matrices begin at `entries`.
static HWY_INLINE void multiply(const float* entries, float factor, const CornerLanes& x,
                                CornerLanes& products) {
    HWY_UNROLL(3)
    for (int axis = 0; axis < 3; ++axis) {
        Lanes sums[8];
        set_zero(sums);
        const float* entry = entries;
        HWY_UNROLL(8)
        for (int i = 0; i < 8; ++i) {
            sums[i] = hn::MulAdd(load(entry), x[axis][i], sums[i]);
            entry += kBlockElements;
            HWY_UNROLL(8)
            for (int j = i + 1; j < 8; ++j, entry += kBlockElements) {
                const Lanes m = load(entry);
                sums[i] = hn::MulAdd(m, x[axis][j], sums[i]);
                sums[j] = hn::MulAdd(m, x[axis][i], sums[j]);
            }
        }
        for (int i = 0; i < 8; ++i) products[axis][i] = splat(factor) * sums[i];
    }
}

/// Calls visit(lane, column) for the column of each lane.
template <int kLane = 0, class Visit>
static HWY_INLINE void for_each_column(const Columns& columns, const Visit& visit) {
    visit(kLane, column_of<kLane>(columns));
    if constexpr (kLane + 1 < kLanes) for_each_column<kLane + 1>(columns, visit);
}

/// Adds the products of `count` elements to the addresses at(target) of their targets.
template <class At>
static HWY_INLINE void add(const std::int32_t* targets, int count, const CornerLanes& products,
                           const At& at) {
    HWY_UNROLL(8)
    for (int i = 0; i < 8; ++i) {
        for_each_column(columns_of(products[0][i], products[1][i], products[2][i]),
                        [&](int lane, const Column& column) HWY_ATTR {
                            if (lane < count) add_to(at(targets[8 * lane + i]), column);
                        });
    }
}

/// Adds products whose targets may be slots: few blocks have any.
void add_to_slots(const std::int32_t* targets, int count, const CornerLanes& products, float* y,
                  float* slots) {
    add(targets, count, products, [&](std::int64_t target) HWY_ATTR {
        return target >= 0 ? y + 4 * target : slots + 4 * (-1 - target);
    });
}

/// Adds the products of all elements to their targets, kLanes elements at a time, and calls
/// visit(x at the corners, products) for them.
template <class Visit>
static HWY_INLINE void add_products(const ElementRange& range, const MatrixBlock* matrices,
                                    float factor, const float* x, float* y, const Visit& visit) {
    Padding padding;
    for (std::int32_t first = range.begin; first < range.end; first += kBlockElements) {
        const Block block = block_at(range, matrices, first, padding);
        for (int lane = 0; lane < block.count; lane += kLanes) {
            const std::int32_t* const targets = block.targets + 8 * lane;
            const int count = block.count - lane;
            CornerLanes at_corners;
            CornerLanes products;
            read_corners(x, block, lane, at_corners);
            multiply(block.matrices->entry[0] + lane, factor, at_corners, products);
            visit(at_corners, products);
            if (!block.direct || count < kLanes) {
                add_to_slots(targets, count, products, y, range.slots);
            } else {
                add(targets, kLanes, products,
                    [&](std::int64_t target) HWY_ATTR { return y + 4 * target; });
            }
        }
    }
}

}  // namespace

void add_element_products(const ElementRange& range, const MatrixBlock* matrices, float factor,
                          const float* x, float* y) {
    add_products(range, matrices, factor, x, y,
                 [](const CornerLanes& /*x*/, const CornerLanes& /*products*/) HWY_ATTR {});
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
