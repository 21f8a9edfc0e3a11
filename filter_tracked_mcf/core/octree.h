#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/morton.h"

namespace tracked_mcf {

/// One level of the octree. An *element* is the surface in one occupied cell; an *unknown* is the
/// coefficient of a test function, the B-spline centred at a corner of occupied cells.
struct Level {
    int depth = 0;                  ///< 2^depth cells along the side of the cube
    std::vector<MortonCode> cells;  ///< of every element, increasing
    /// Of every element: the unknowns of the eight functions of its cell (numbered as in
    /// bspline.h).
    std::vector<std::array<std::int32_t, 8>> unknowns;
    /// Of every element: the element of the next coarser level that contains it; empty at level 0.
    std::vector<std::int32_t> parents;
    /// Of every unknown: its corner's layer, the z coordinate. Unknowns are numbered
    /// lexicographically, x fastest, so layers never decrease.
    std::vector<std::int32_t> layers;

    std::int32_t element_count() const { return static_cast<std::int32_t>(cells.size()); }
    std::int32_t unknown_count() const { return static_cast<std::int32_t>(layers.size()); }
};

/// All levels above `finest_cells` (increasing, without repetition), which lie at `depth`. Level 0,
/// the coarsest, is the whole cube; level l has 2^l cells a side. Throws InvalidParameter if there
/// are more than can be numbered.
std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, int depth);

/// Number of unknowns of a level with these cells (increasing, without repetition) at `depth`.
std::int64_t count_unknowns(std::vector<MortonCode> cells, int depth);

}  // namespace tracked_mcf
