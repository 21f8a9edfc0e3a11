#pragma once

#include "filter_tracked_mcf/core/element_matrix.h"
#include "filter_tracked_mcf/core/kernels/lanes.h"

// For coarsen_elements.cpp alone, see lanes.h.

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// The whole matrices of a block.
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
                const int place = kEntryPlaces.of[(begin + i) / 8][(begin + i) % 8];
                rows[i] = load(block.entry[place] + first);
            }
            transpose(rows);
            for (int i = 0; i < kLanes; ++i) {
                store(rows[i], matrices.of[first + i].entry[0] + begin);
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
                rows[i] = load(matrices.of[first + i].entry[0] + begin);
            }
            transpose(rows);
#pragma GCC unroll 16
            for (int i = 0; i < kLanes; ++i) {
                const int row = (begin + i) / 8;
                const int column = (begin + i) % 8;
                if (column < row) continue;
                store(rows[i], block.entry[kEntryPlaces.of[row][column]] + first);
            }
        }
    }
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
