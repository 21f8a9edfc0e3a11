// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/noise/lattice.h"
#include "filter_tracked_mcf/core/noise/parts.h"

namespace tracked_mcf {

/// Parts of a surface that are the border of the cells of one lattice. The lengths of `surface` are
/// in cells.
struct Labels : SurfaceParts {
    Lattice lattice;
    double subdivision = 1;  ///< sides of the grid that the triangles are on, per cell
    std::array<bool, 3> has_stairs =
        {};                            ///< per side: planes follow each other at a cell's distance
    std::vector<std::uint8_t> uneven;  ///< per vertex: whether its star is not in one plane
    std::vector<std::uint8_t>
        flat_sides;  ///< per vertex: bit i if it is on a flat side across side i

    /// Returns the length of the longest side with stairs, of all sides if none has; in edges of
    /// the whole surface.
    double height() const;
};

/// Returns the labels among the parts of a surface, those with the largest part first.
///
/// A part too small for a lattice of its own may be on that of a larger one. Planes of faces follow
/// each other at the distance of a cell along two sides at least. If all planes are at multiples of
/// several cells, as after resampling to a finer grid, cells are as large as these.
///
/// A side of the shape is flat, rather than a terrace, if its plane is some cells wide and no plane
/// follows at the distance of a cell.
std::vector<Labels> labels_of(const NoisySurface& surface, std::vector<PartRange> parts);

}  // namespace tracked_mcf
