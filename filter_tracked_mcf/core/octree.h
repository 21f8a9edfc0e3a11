#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/links.h"
#include "filter_tracked_mcf/core/morton.h"

namespace tracked_mcf {

/// One level of the octree. An *element* is the surface in one occupied cell, or, with separated
/// sheets, a connected part of it; an *unknown* is the coefficient of a test function: the B-spline
/// centred at a corner of occupied cells, or, with separated sheets, what it is on one connected
/// part of the surface in its support, and zero on the others.
struct Level {
    int depth = 0;                  ///< 2^depth cells along the side of the cube
    std::vector<MortonCode> cells;  ///< of every element, never decreasing
    /// Of every element: the unknowns of the eight functions of its cell (numbered as in
    /// bspline.h).
    std::vector<std::array<std::int32_t, 8>> unknowns;
    /// Of every element: the element of the next coarser level that contains it; empty at level 0.
    std::vector<std::int32_t> parents;
    /// Unknowns are numbered as the elements, one after the other, have them first: what is near in
    /// space is near in memory.
    std::int32_t number_of_unknowns = 0;

    std::int32_t element_count() const { return static_cast<std::int32_t>(cells.size()); }
    std::int32_t unknown_count() const { return number_of_unknowns; }
};

/// All levels above `finest_cells` (increasing, without repetition), which lie at `depth`. Level 0,
/// the coarsest, is the whole cube; level l has 2^l cells a side. Throws InvalidParameter if there
/// are more than can be numbered.
std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, int depth);

/// The same for separated sheets, given the cell of every finest element (never decreasing) and the
/// links between them. An element of a coarser level is what of the surface is connected inside its
/// cell, so level 0 has one for each connected part of the surface. A coarse function's part holds
/// the parts of finer functions that lie in it completely, so the levels nest exactly.
std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, RawVector<Link> links,
                                int depth);

/// The corner of a cell (numbered as in bspline.h), grid coordinates.
Cell corner_of(const Cell& cell, int corner);

/// Number of different cells of a level.
std::int64_t count_cells(const Level& level);

/// Number of unknowns of a level with these cells (increasing, without repetition).
std::int64_t count_unknowns(const std::vector<MortonCode>& cells);

}  // namespace tracked_mcf
