// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"

namespace tracked_mcf {

/// Where a surface is as flat as its positions can tell. Noise leaves hardly an edge flat.
struct Flatness {
    std::vector<float> share;  ///< per vertex: of flat edges; 1: the vertex is flat
    /// Share of flat edges among those between vertices that are not flat. Parts that are modelled
    /// with as few vertices as possible have many.
    double edges = 0;

    bool is_flat(std::int32_t vertex) const { return share[vertex] == 1; }
};

/// Finds the edges between two triangles that turn by less than 0.02°, or than positions with an
/// error of `rounding`, in edges, can tell.
Flatness flatness_of(const Stars& stars, const Positions& positions, double rounding);

/// Returns the standard deviation of the lengths of a surface's edges over their mean.
double variation_of_edges(const Stars& stars, const Positions& positions);

}  // namespace tracked_mcf
