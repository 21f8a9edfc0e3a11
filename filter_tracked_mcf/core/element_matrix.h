#pragma once

#include <cstdint>

// Plain structs and constants only: the kernels include this (see kernels/kernel_table.h).

namespace tracked_mcf {

/// The matrix of one element, whole: a row and a column for each of its cell's eight functions.
/// Symmetric. A level's are stored in MatrixBlocks.
struct ElementMatrix {
    alignas(32) float entry[8][8];
};

/// Entries of such a matrix on and above the diagonal, row by row.
inline constexpr int kMatrixEntries = 36;

/// Where among them the entry of a row and a column is, in either order.
struct EntryPlaces {
    std::uint8_t of[8][8];
};

constexpr EntryPlaces make_entry_places() {
    EntryPlaces places{};
    std::uint8_t next = 0;
    for (int row = 0; row < 8; ++row) {
        for (int column = row; column < 8; ++column) {
            places.of[row][column] = places.of[column][row] = next++;
        }
    }
    return places;
}

constexpr EntryPlaces kEntryPlaces = make_entry_places();

/// Consecutive elements whose matrices are stored side by side.
inline constexpr int kBlockElements = 16;

/// Their matrices, entry by entry, so that kernels can work on several elements at a time.
struct MatrixBlock {
    alignas(64) float entry[kMatrixEntries][kBlockElements];
};

/// The displacement system's right side of one element: for each coordinate the eight functions'.
struct ElementVector {
    alignas(32) float entry[3][8];
};

/// Samples whose deformed area is at most this fraction of their initial area have collapsed: the
/// surface there has become a thread or a point and its metric means nothing. They contribute
/// nothing (section 5.1). Not so in a conformalized flow, where the stiffness is that of the
/// initial metric and nothing is divided by an area.
inline constexpr float kCollapsedAreaRatio = 1e-4F;

/// What has collapsed of one element: of each function ∫ B_I² over that part of the initial
/// surface.
struct Collapse {
    std::int32_t element;
    std::int32_t samples;
    float mass[8];
};

}  // namespace tracked_mcf
