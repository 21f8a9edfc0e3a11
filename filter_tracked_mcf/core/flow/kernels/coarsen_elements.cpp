// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/coarsen_elements.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/flow/kernels/coarsen_elements.cpp"
#include "filter_tracked_mcf/core/flow/kernels/targets.h"

#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

namespace {

/// The matrices of a block, each with all 64 entries.
struct WholeMatrices {
    ElementMatrix of[kBlockElements];
};

static HWY_INLINE void unpack(const MatrixBlock& block, WholeMatrices& matrices) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
        HWY_UNROLL(16)
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
            HWY_UNROLL(16)
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

static HWY_INLINE void pack(const WholeMatrices& matrices, MatrixBlock& block) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
        HWY_UNROLL(16)
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
            for (int i = 0; i < kLanes; ++i) {
                rows[i] = load(&matrices.of[first + i].entry[begin / 8][begin % 8]);
            }
            transpose(rows);
            HWY_UNROLL(16)
            for (int i = 0; i < kLanes; ++i) {
                const int row = (begin + i) / 8;
                const int column = (begin + i) % 8;
                if (column < row) continue;
                store(rows[i], block.entry[kEntryIndices.of[row][column]] + first);
            }
        }
    }
}

/// A row of a matrix takes one vector, or two of four lanes.
constexpr hn::CappedTag<float, 8> kRow;
constexpr int kVectorLanes = static_cast<int>(hn::MaxLanes(kRow));
constexpr int kVectors = 8 / kVectorLanes;
using RowLanes = hn::Vec<decltype(kRow)>;

struct Row {
    RowLanes lanes[kVectors];
};
struct Rows {
    Row row[8];
};

/// Adds a row and `factor` times another one.
static HWY_INLINE Row add(const Row& a, float factor, const Row& b) {
    Row sum;
    for (int i = 0; i < kVectors; ++i) {
        sum.lanes[i] = hn::MulAdd(hn::Set(kRow, factor), b.lanes[i], a.lanes[i]);
    }
    return sum;
}
static HWY_INLINE Row half_of(const Row& a) {
    Row half;
    for (int i = 0; i < kVectors; ++i) half.lanes[i] = hn::Set(kRow, 0.5F) * a.lanes[i];
    return half;
}

static HWY_INLINE Row load_row(const float* from) {
    Row row;
    for (int i = 0; i < kVectors; ++i) row.lanes[i] = hn::Load(kRow, from + i * kVectorLanes);
    return row;
}

static HWY_INLINE Rows zero_rows() {
    Rows rows;
    for (Row& row : rows.row) {
        for (RowLanes& lanes : row.lanes) lanes = hn::Zero(kRow);
    }
    return rows;
}

static HWY_INLINE void store_rows(const Rows& rows, ElementMatrix& matrix) {
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < kVectors; ++k) {
            hn::Store(rows.row[i].lanes[k], kRow, matrix.entry[i] + k * kVectorLanes);
        }
    }
}

/// Returns a row with the entries of the two corners of each cell edge along the axis exchanged.
template <int Axis>
static HWY_INLINE Row other_end(const Row& row) {
    Row other;
    for (int i = 0; i < kVectors; ++i) {
        const RowLanes lanes = row.lanes[i];
        if (Axis == 0) {
            other.lanes[i] = hn::Shuffle2301(lanes);
        } else if (Axis == 1) {
            other.lanes[i] = hn::Shuffle1032(lanes);
        } else {
            other.lanes[kVectors - 1 - i] = hn::SwapAdjacentBlocks(lanes);
        }
    }
    return other;
}

/// For each axis, the weights of a child's entries: 1 for corners on the outer side, half for those
/// in the parent's middle. First if the lower side is outer, then if the upper side is.
alignas(32) constexpr float kKeep[3][2][8] = {
    {{1, .5, 1, .5, 1, .5, 1, .5}, {.5, 1, .5, 1, .5, 1, .5, 1}},
    {{1, 1, .5, .5, 1, 1, .5, .5}, {.5, .5, 1, 1, .5, .5, 1, 1}},
    {{1, 1, 1, 1, .5, .5, .5, .5}, {.5, .5, .5, .5, 1, 1, 1, 1}}};

/// Multiplies by the factor of P_c that belongs to one axis, from both sides. Along the axis, the
/// child has an outer function, at the parent's corner, and one in the parent's middle. The outer
/// one belongs to the parent's function at that corner; the middle one belongs half to each of the
/// parent's two functions.
template <int Axis>
static HWY_INLINE void coarsen_axis(Rows& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    const Row keep = load_row(kKeep[Axis][upper_child ? 1 : 0]);
    HWY_UNROLL(8)
    for (Row& row : m.row) {
        const Row other = other_end<Axis>(row);
        for (int k = 0; k < kVectors; ++k) {
            const RowLanes take = keep.lanes[k] - hn::Set(kRow, 0.5F);
            row.lanes[k] = hn::MulAdd(keep.lanes[k], row.lanes[k], take * other.lanes[k]);
        }
    }
    HWY_UNROLL(8)
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const Row low = m.row[lower];
        const Row high = m.row[lower + step];
        m.row[lower] = upper_child ? half_of(low) : add(low, 0.5F, high);
        m.row[lower + step] = upper_child ? add(high, 0.5F, low) : half_of(high);
    }
}

/// Reads matrices and keeps the block it read last unpacked.
struct Reader {
    const MatrixBlock* blocks;
    std::int32_t block;
    WholeMatrices matrices;
};

static HWY_INLINE Rows read(Reader& reader, std::int32_t element) {
    const std::int32_t block = element / kBlockElements;
    if (block != reader.block) {
        reader.block = block;
        unpack(reader.blocks[block], reader.matrices);
    }
    Rows rows;
    for (int i = 0; i < 8; ++i) {
        rows.row[i] = load_row(reader.matrices.of[element % kBlockElements].entry[i]);
    }
    return rows;
}

static HWY_INLINE Rows sum_of_children(const ChildElements& elements, std::int32_t parent,
                                       Reader& reader) {
    Rows sum = zero_rows();
    for (std::int64_t k = elements.begin[parent]; k < elements.begin[parent + 1]; ++k) {
        const std::int32_t child = elements.children[k];
        Rows matrix = read(reader, child);
        const std::uint64_t octant = elements.cells[child];
        coarsen_axis<0>(matrix, (octant & 1U) != 0);
        coarsen_axis<1>(matrix, (octant & 2U) != 0);
        coarsen_axis<2>(matrix, (octant & 4U) != 0);
        for (int i = 0; i < 8; ++i) sum.row[i] = add(sum.row[i], 1, matrix.row[i]);
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
            const Rows sum = parent < end ? sum_of_children(elements, parent, reader) : zero_rows();
            store_rows(sum, sums.of[lane]);
        }
        pack(sums, parents[first / kBlockElements]);
    }
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
