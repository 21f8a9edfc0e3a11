// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

struct Cracks {
    CrackReport report;
    /// Pairs of vertices of the surface that are to be one, the smaller first.
    std::vector<std::array<std::int32_t, 2>> joined;
};

/// Finds the cracks of a surface.
///
/// A pair consists of two vertices on the rim that are nearer to each other than to any other
/// one, where the next ones along their rims are a pair, too, or the same vertex. No triangle has
/// both. A pair is joined if its distance is at most 1e-6 of the diagonal and 1e-4 of the shortest
/// edge at either vertex, so a slit of a thousandth of an edge stays open. Up to 1e-2 of that edge,
/// it counts as an open pair. Neither depends on the order of the vertices.
Cracks find_cracks(const TriangleMesh& mesh, const Surface& surface);

}  // namespace tracked_mcf
