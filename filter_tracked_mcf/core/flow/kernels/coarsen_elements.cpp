// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/coarsen_elements.h"

#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

namespace tracked_mcf::kernels {

namespace {

/// All 64 entries of an element's matrix.
using Matrix = Eigen::Array<float, 8, 8, Eigen::RowMajor>;
using Row = Eigen::Array<float, 1, 8>;

/// The matrices of a block.
struct WholeMatrices {
    Matrix of[kBlockElements];
};

inline void unpack(const MatrixBlock& block, WholeMatrices& matrices) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
            for (int i = 0; i < kLanes; ++i) {
                const int entry = kEntryIndices.of[(begin + i) / 8][(begin + i) % 8];
                rows[i] = load(block.entry[entry] + first);
            }
            transpose(rows);
            for (int i = 0; i < kLanes; ++i) {
                store(rows[i], matrices.of[first + i].data() + begin);
            }
        }
    }
}

inline void pack(const WholeMatrices& matrices, MatrixBlock& block) {
    for (int first = 0; first < kBlockElements; first += kLanes) {
        for (int begin = 0; begin < 64; begin += kLanes) {
            Lanes rows[kLanes];
            for (int i = 0; i < kLanes; ++i) {
                rows[i] = load(matrices.of[first + i].data() + begin);
            }
            transpose(rows);
            for (int i = 0; i < kLanes; ++i) {
                const int row = (begin + i) / 8;
                const int column = (begin + i) % 8;
                if (column < row) continue;
                store(rows[i], block.entry[kEntryIndices.of[row][column]] + first);
            }
        }
    }
}

/// Returns a row with the entries of the two corners of each cell edge along the axis exchanged.
template <int Axis>
inline Row other_end(const Row& row) {
    Row other;
    for (int i = 0; i < 8; ++i) other[i] = row[i ^ (1 << Axis)];
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
inline void coarsen_axis(Matrix& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    const Row keep = Eigen::Map<const Row>(kKeep[Axis][upper_child ? 1 : 0]), take = keep - 0.5F;
    for (int i = 0; i < 8; ++i) {
        const Row row = m.row(i);
        m.row(i) = keep * row + take * other_end<Axis>(row);
    }
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const Row low = m.row(lower), high = m.row(lower + step);
        m.row(lower) = upper_child ? Row(0.5F * low) : Row(0.5F * high + low);
        m.row(lower + step) = upper_child ? Row(0.5F * low + high) : Row(0.5F * high);
    }
}

/// Reads matrices and keeps the block it read last unpacked.
struct Reader {
    const MatrixBlock* blocks;
    std::int32_t block;
    WholeMatrices matrices;
};

inline const Matrix& read(Reader& reader, std::int32_t element) {
    const std::int32_t block = element / kBlockElements;
    if (block != reader.block) {
        reader.block = block;
        unpack(reader.blocks[block], reader.matrices);
    }
    return reader.matrices.of[element % kBlockElements];
}

Matrix sum_of_children(const ChildElements& elements, std::int32_t parent, Reader& reader) {
    Matrix sum = Matrix::Zero();
    for (std::int64_t k = elements.begin[parent]; k < elements.begin[parent + 1]; ++k) {
        const std::int32_t child = elements.children[k];
        Matrix matrix = read(reader, child);
        const std::uint64_t octant = elements.cells[child];
        coarsen_axis<0>(matrix, (octant & 1U) != 0);
        coarsen_axis<1>(matrix, (octant & 2U) != 0);
        coarsen_axis<2>(matrix, (octant & 4U) != 0);
        sum += matrix;
    }
    return sum;
}

}  // namespace

}  // namespace tracked_mcf::kernels

namespace tracked_mcf {

void coarsen_elements(const ChildElements& elements, std::int32_t begin, std::int32_t end,
                      MatrixBlock* parents) {
    using namespace kernels;
    Reader reader;
    reader.blocks = elements.matrices;
    reader.block = -1;
    WholeMatrices sums;
    for (std::int32_t first = begin; first < end; first += kBlockElements) {
        for (int lane = 0; lane < kBlockElements; ++lane) {
            const std::int32_t parent = first + lane;
            sums.of[lane].setZero();
            if (parent < end) sums.of[lane] = sum_of_children(elements, parent, reader);
        }
        pack(sums, parents[first / kBlockElements]);
    }
}

}  // namespace tracked_mcf
