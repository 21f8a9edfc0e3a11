// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/coarsen_elements.h"

#include "filter_tracked_mcf/core/kernels/lanes.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

namespace {

/// The matrices of a block, each with all 64 entries.
struct WholeMatrices {
    ElementMatrix of[kBlockElements];
};

TRACKED_MCF_INLINE void unpack(const MatrixBlock& block, WholeMatrices& matrices) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
#pragma GCC unroll 16
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
#pragma GCC unroll 16
            for (int i = 0; i < kLanes; ++i) {
                const int entry = kEntryIndices.of[(begin + i) / 8][(begin + i) % 8];
                rows[i] = load(block.entry[entry] + first);
            }
            transpose(rows);
            for (int i = 0; i < kLanes; ++i) {
                store(rows[i], &matrices.of[first + i].entry[begin / 8][begin % 8]);
            }
        }
    }
}

TRACKED_MCF_INLINE void pack(const WholeMatrices& matrices, MatrixBlock& block) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
#pragma GCC unroll 16
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
            for (int i = 0; i < kLanes; ++i) {
                rows[i] = load(&matrices.of[first + i].entry[begin / 8][begin % 8]);
            }
            transpose(rows);
#pragma GCC unroll 16
            for (int i = 0; i < kLanes; ++i) {
                const int row = (begin + i) / 8;
                const int column = (begin + i) % 8;
                if (column < row) continue;
                store(rows[i], block.entry[kEntryIndices.of[row][column]] + first);
            }
        }
    }
}

using Row = float __attribute__((vector_size(32)));

struct Rows {
    Row row[8];
};

/// For each axis, 1 for the corners on its upper side.
constexpr Row kUpper[3] = {
    {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};

/// Returns v with the entries of the two corners of each cell edge along the axis exchanged.
template <int Axis>
TRACKED_MCF_INLINE Row other_end(Row v) {
    if (Axis == 0) return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
    if (Axis == 1) return __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
    return __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
}

/// Multiplies by the factor of P_c that belongs to one axis, from both sides. Along the axis, the
/// child has an outer function, at the parent's corner, and one in the parent's middle. The outer
/// one belongs to the parent's function at that corner; the middle one belongs half to each of the
/// parent's two functions.
template <int Axis>
TRACKED_MCF_INLINE void coarsen_axis(Rows& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    const Row is_outer = upper_child ? kUpper[Axis] : 1 - kUpper[Axis];
    const Row keep = 0.5F + 0.5F * is_outer;
    const Row take = 0.5F * is_outer;
#pragma GCC unroll 8
    for (Row& row : m.row) row = keep * row + take * other_end<Axis>(row);
#pragma GCC unroll 8
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const Row low = m.row[lower];
        const Row high = m.row[lower + step];
        m.row[lower] = upper_child ? 0.5F * low : low + 0.5F * high;
        m.row[lower + step] = upper_child ? high + 0.5F * low : 0.5F * high;
    }
}

/// Reads matrices and keeps the block it read last unpacked.
struct Reader {
    const MatrixBlock* blocks;
    std::int32_t block;
    WholeMatrices matrices;
};

TRACKED_MCF_INLINE Rows read(Reader& reader, std::int32_t element) {
    const std::int32_t block = element / kBlockElements;
    if (block != reader.block) {
        reader.block = block;
        unpack(reader.blocks[block], reader.matrices);
    }
    Rows rows;
    __builtin_memcpy(&rows, &reader.matrices.of[element % kBlockElements], sizeof rows);
    return rows;
}

TRACKED_MCF_INLINE Rows sum_of_children(const ChildElements& elements, std::int32_t parent,
                                        Reader& reader) {
    Rows sum = {};
    for (std::int64_t k = elements.begin[parent]; k < elements.begin[parent + 1]; ++k) {
        const std::int32_t child = elements.children[k];
        Rows matrix = read(reader, child);
        const std::uint64_t octant = elements.cells[child];
        coarsen_axis<0>(matrix, (octant & 1U) != 0);
        coarsen_axis<1>(matrix, (octant & 2U) != 0);
        coarsen_axis<2>(matrix, (octant & 4U) != 0);
        for (int i = 0; i < 8; ++i) sum.row[i] += matrix.row[i];
    }
    return sum;
}

}  // namespace

void coarsen_elements(const ChildElements& elements, std::int32_t begin, std::int32_t end,
                      MatrixBlock* parents) {
    Reader reader;
    reader.blocks = elements.matrices;
    reader.block = -1;
    WholeMatrices sums;
    for (std::int32_t first = begin; first < end; first += kBlockElements) {
        for (int lane = 0; lane < kBlockElements; ++lane) {
            const std::int32_t parent = first + lane;
            const Rows sum = parent < end ? sum_of_children(elements, parent, reader) : Rows{};
            __builtin_memcpy(&sums.of[lane], &sum, sizeof sum);
        }
        pack(sums, parents[first / kBlockElements]);
    }
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
