// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace tracked_mcf {

/// The symmetric matrix of one element, a row and a column for each of its cell's eight functions.
/// The matrices of a level are stored in MatrixBlocks.
struct ElementMatrix {
    alignas(32) float entry[8][8];
};

/// Entries of an ElementMatrix on and above the diagonal, numbered row by row.
inline constexpr int kMatrixEntries = 36;

/// The number of the entry of a row and a column, in either order.
struct EntryIndices {
    std::uint8_t of[8][8];
};

constexpr EntryIndices make_entry_indices() {
    EntryIndices indices{};
    std::uint8_t next = 0;
    for (int row = 0; row < 8; ++row) {
        for (int column = row; column < 8; ++column) {
            indices.of[row][column] = indices.of[column][row] = next++;
        }
    }
    return indices;
}

constexpr EntryIndices kEntryIndices = make_entry_indices();

/// Number of consecutive elements whose matrices are stored side by side.
inline constexpr int kBlockElements = 16;

/// The matrices of a block of elements. Equal entries of different elements are neighbours, so that
/// kernels can work on several elements at a time.
struct MatrixBlock {
    alignas(64) float entry[kMatrixEntries][kBlockElements];
};

/// The right-hand side of one element: eight numbers for each coordinate.
struct ElementVector {
    alignas(32) float entry[3][8];
};

/// A sample has collapsed if its deformed area is at most this fraction of its initial area. The
/// surface there has become a thread or a point, and its metric means nothing. A collapsed sample
/// contributes nothing (section 5.1).
inline constexpr float kCollapsedAreaRatio = 1e-4F;

}  // namespace tracked_mcf
