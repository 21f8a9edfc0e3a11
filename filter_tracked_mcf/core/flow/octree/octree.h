// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

/// One level of the octree.
///
/// An *element* is the surface in one occupied cell, as in the paper, or a connected part of it, a
/// sheet. An *unknown* is the coefficient of a function: of the B-spline centred at a corner of
/// occupied cells, or of that B-spline on one connected part of the surface in its support, which
/// is zero on the other parts.
struct Level {
    int depth = 0;                  ///< 2^depth cells along the side of the cube
    std::vector<MortonCode> cells;  ///< per element, never decreasing
    /// Per element: the unknowns at the corners of its cell, numbered as in bspline.h.
    std::vector<std::array<std::int32_t, 8>> unknowns;
    /// Per element: the element of the next coarser level that contains it. Empty at level 0.
    std::vector<std::int32_t> parents;
    /// Unknowns are numbered in the order in which elements and their corners first have them. What
    /// is near in space is near in memory.
    std::int32_t number_of_unknowns = 0;
    Groups corners;  ///< by unknown: 8 * element + corner of the cells' corners that have it

    std::int32_t element_count() const { return static_cast<std::int32_t>(cells.size()); }
    std::int32_t unknown_count() const { return number_of_unknowns; }
};

/// Two elements of one level, first < second, in different cells that touch. The surface connects
/// them inside the support of every function that both cells have.
struct Link {
    std::int32_t first, second;
};

/// Sorts the links between `element_count` elements by first, then second, and removes copies.
void sort_and_remove_copies(RawVector<Link>& links, std::int32_t element_count);

/// Returns the levels of an octree with one element per cell, coarsest first. Level 0 is the whole
/// cube; level l has 2^l cells a side. `finest_cells` (increasing, each once) are those of level
/// `depth`. Throws InvalidParameter if there are more elements than can be numbered.
std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, int depth);

/// Returns the levels of an octree whose elements are sheets, coarsest first. `finest_cells` (never
/// decreasing) are the cells of the finest elements, `links` the links between these elements.
///
/// A coarser element is a set of linked elements with the same parent cell, so level 0 has one
/// element for each connected component of the surface. The levels nest exactly: a fine function
/// lies in one part of each coarse function over it.
std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, RawVector<Link> links,
                                int depth);

/// Returns a corner of a cell, numbered as in bspline.h, in grid coordinates.
Cell corner_of(const Cell& cell, int corner);

/// Returns the number of different cells of a level.
std::int64_t count_cells(const Level& level);

}  // namespace tracked_mcf
