// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/element_products.h"

#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

namespace tracked_mcf::kernels {

namespace {

/// [axis][corner]: one coordinate at one corner, for as many elements as there are lanes.
using CornerLanes = Lanes[3][8];

/// A block of a range's elements.
struct Block {
    const MatrixBlock* matrices;
    const std::int32_t* unknowns;  ///< eight for each of kBlockElements elements
    const std::int32_t* targets;   ///< eight for each of `count` elements
    int count;                     ///< number of elements, less than kBlockElements in a last block
    bool direct;                   ///< the targets are the unknowns
};

/// The unknowns of an incomplete last block, padded: any unknown will do where the matrix is zero.
using Padding = std::int32_t[8 * kBlockElements];

inline Block block_at(const ElementRange& range, const MatrixBlock* matrices, std::int32_t first,
                      Padding& padding) {
    const std::int32_t left = range.end - first;
    const std::int64_t offset = range.target_offsets[first / kBlockElements];
    const bool direct = offset == ElementRange::kDirect;
    const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * first;
    Block block = {matrices + first / kBlockElements, unknowns,
                   direct ? unknowns : range.targets + offset,
                   left < kBlockElements ? left : kBlockElements, direct};
    if (left < kBlockElements) {
        for (int i = 0; i < 8 * kBlockElements; ++i) {
            padding[i] = unknowns[i < 8 * left ? i : 0];
        }
        block.unknowns = padding;
    }
    return block;
}

/// Reads the coordinates at all corners. A column of x has x, y, z and a zero.
inline void read_corners(const float* x, const Block& block, int lane, CornerLanes& corners) {
    for (int corner = 0; corner < 8; ++corner) {
        Lanes columns[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            columns[i] = load(x + std::int64_t{4} * block.unknowns[8 * (lane + i) + corner]);
        }
        transpose(columns);
        for (int axis = 0; axis < 3; ++axis) corners[axis][corner] = columns[axis];
    }
}

/// Computes products = factor * M x for the elements whose matrices begin at `entries`.
inline void multiply(const float* entries, float factor, const CornerLanes& x,
                     CornerLanes& products) {
    for (int axis = 0; axis < 3; ++axis) {
        Lanes sums[8];
        set_zero(sums);
        const float* entry = entries;
        for (int i = 0; i < 8; ++i) {
            sums[i] += load(entry) * x[axis][i];
            entry += kBlockElements;
            for (int j = i + 1; j < 8; ++j, entry += kBlockElements) {
                const Lanes m = load(entry);
                sums[i] += m * x[axis][j];
                sums[j] += m * x[axis][i];
            }
        }
        for (int i = 0; i < 8; ++i) products[axis][i] = splat(factor) * sums[i];
    }
}

/// Adds the products of `count` elements to the addresses at(target) of their targets.
template <class At>
inline void add(const std::int32_t* targets, int count, const CornerLanes& products, const At& at) {
    for (int i = 0; i < 8; ++i) {
        Lanes columns[kLanes] = {products[0][i], products[1][i], products[2][i], zero()};
        transpose(columns);
        for (int lane = 0; lane < kLanes && lane < count; ++lane) {
            float* const to = at(targets[8 * lane + i]);
            store(load(to) + columns[lane], to);
        }
    }
}

/// Adds products whose targets may be slots: few blocks have any.
void add_to_slots(const std::int32_t* targets, int count, const CornerLanes& products, float* y,
                  float* slots) {
    add(targets, count, products, [&](std::int64_t target) {
        return target >= 0 ? y + 4 * target : slots + 4 * (-1 - target);
    });
}

}  // namespace

}  // namespace tracked_mcf::kernels

namespace tracked_mcf {

void add_element_products(const ElementRange& range, const MatrixBlock* matrices, float factor,
                          const float* x, float* y) {
    using namespace kernels;
    Padding padding;
    for (std::int32_t first = range.begin; first < range.end; first += kBlockElements) {
        const Block block = block_at(range, matrices, first, padding);
        for (int lane = 0; lane < block.count; lane += kLanes) {
            const std::int32_t* const targets = block.targets + 8 * lane;
            const int count = block.count - lane;
            CornerLanes at_corners, products;
            read_corners(x, block, lane, at_corners);
            multiply(block.matrices->entry[0] + lane, factor, at_corners, products);
            if (!block.direct || count < kLanes) {
                add_to_slots(targets, count, products, y, range.slots);
            } else {
                add(targets, kLanes, products, [&](std::int64_t target) { return y + 4 * target; });
            }
        }
    }
}

}  // namespace tracked_mcf
