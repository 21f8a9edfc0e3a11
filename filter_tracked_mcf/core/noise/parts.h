// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// A connected part of a surface: its vertices and its triangles follow each other.
struct PartRange {
    std::int32_t first_vertex = 0, end_vertex = 0;
    std::int64_t first_triangle = 0, end_triangle = 0;

    std::int32_t vertex_count() const { return end_vertex - first_vertex; }
};

/// Returns all of a surface as if it were one part.
PartRange whole_of(const NoisySurface& surface);

/// Returns the parts of a surface, given the number of each vertex's part; see Surface::parts.
std::vector<PartRange> part_ranges(const Stars& stars, const std::vector<std::int32_t>& numbers);

/// Some parts of a surface as a surface by themselves.
struct SurfaceParts {
    NoisySurface surface;
    std::vector<std::int32_t> vertices;  ///< per vertex: that of the whole surface
    std::vector<PartRange> ranges;       ///< of `surface`
};

/// Takes the parts in their order.
SurfaceParts parts_from(const NoisySurface& surface, const std::vector<PartRange>& parts);

/// Returns the positions of about so many vertices of a part, or of all.
std::vector<Eigen::Vector3d> some_positions(const NoisySurface& surface, const PartRange& part,
                                            std::int32_t count);

/// Returns the mean length of the sides of a surface's triangles.
double mean_edge_of(const NoisySurface& surface);

}  // namespace tracked_mcf
