// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Marks the vertices that the triangles use.
template <class Triangles>
Marks vertices_of(const Triangles& triangles, std::size_t vertex_count) {
    Marks used(static_cast<std::int64_t>(vertex_count));
    parallel_for_items(triangles, [&](const Triangle& triangle) {
        for (const std::int32_t vertex : triangle) used.set(vertex);
    });
    return used;
}

/// Returns, per vertex, 1 if a triangle uses it, else 0.
std::vector<std::uint8_t> referenced_vertices(const SurfaceView& surface);

/// Returns, per referenced vertex, the smallest index of a referenced vertex at exactly the same
/// position, and per unreferenced vertex its own index. 0 and -0 are the same coordinate.
std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh);

}  // namespace tracked_mcf
