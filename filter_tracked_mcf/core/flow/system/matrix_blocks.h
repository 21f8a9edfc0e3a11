// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The number of the stored entry of a row and a column, in either order.
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

/// The symmetric matrix of one element, a row and a column for each of its cell's eight functions.
/// Only the entries on and above the diagonal are stored, row by row.
struct ElementMatrix {
    float entry[36];

    float operator()(int row, int column) const { return entry[kEntryIndices.of[row][column]]; }
    /// Returns the entry that stands for both (row, column) and (column, row).
    float& operator()(int row, int column) { return entry[kEntryIndices.of[row][column]]; }
};

/// The element matrices of a level: the blocks of eight rows and columns whose sum is its matrix.
using MatrixBlocks = RawVector<ElementMatrix>;

}  // namespace tracked_mcf
