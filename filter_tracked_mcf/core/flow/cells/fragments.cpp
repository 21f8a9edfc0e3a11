// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/fragments.h"

#include <algorithm>
#include <atomic>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/cells/clip.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

// Masks of FragmentEntry's bit-fields.
constexpr std::uint64_t kCellBits = (std::uint64_t{1} << 40U) - 1;
constexpr unsigned kCountBits = 0xff;
constexpr unsigned kFlagBits = 0xf;

Eigen::Vector3d rounded(const Eigen::Vector3d& position) {
    constexpr double steps_per_cell = 0x1p30;
    return (steps_per_cell * position).array().round() / steps_per_cell;
}

unsigned corners_in(const Polygon& polygon) {
    unsigned corners = 0;
    for (int i = 0; i < polygon.size; ++i) {
        if (polygon.corner[i] != Polygon::kNone) corners |= 1U << polygon.corner[i];
    }
    return corners;
}

unsigned edges_in(const Polygon& polygon) {
    unsigned edges = 0;
    for (int i = 0; i < polygon.size; ++i) {
        if (polygon.edge[i] != Polygon::kNone &&
            polygon.points[i] != polygon.points[polygon.next(i)]) {
            edges |= 1U << polygon.edge[i];
        }
    }
    return edges;
}

/// Appends the fragments of a triangle.
void add_fragments(const std::array<Eigen::Vector3d, 3>& corners, std::int32_t triangle,
                   bool degenerate, std::int32_t cells_per_side,
                   std::vector<FragmentEntry>& fragments, Pacer& pacer) {
    for_each_fragment(corners, cells_per_side, [&](const Cell& cell, const Polygon& polygon) {
        FragmentEntry fragment{};
        fragment.cell = morton_code(cell) & kCellBits;
        fragment.split_triangles =
            degenerate ? 0U : static_cast<unsigned>(std::max(polygon.size - 2, 0)) & kCountBits;
        fragment.corners = corners_in(polygon) & kFlagBits;
        fragment.edges = edges_in(polygon) & kFlagBits;
        fragment.triangle = triangle;
        fragments.push_back(fragment);
        pacer.did(kItemsPerFragment);
    });
}

void check_inside(const std::array<Eigen::Vector3d, 3>& corners, std::int32_t cells_per_side) {
    for (const Eigen::Vector3d& corner : corners) {
        if (!(corner.minCoeff() >= 0 && corner.maxCoeff() <= cells_per_side)) {
            throw InvalidMesh("The mesh does not lie inside the cube of the grid.");
        }
    }
}

/// Returns the fragments, triangle by triangle, and counts the degenerate triangles.
RawVector<FragmentEntry> list_fragments(ClippedSurface& surface) {
    const auto count = static_cast<std::int64_t>(surface.mesh.triangles.size());
    const std::int32_t cells_per_side = surface.grid.cells_per_side();
    std::atomic<std::int64_t> degenerate_count{0};
    auto fragments = parallel_collect<FragmentEntry, RawVector<FragmentEntry>>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<FragmentEntry>& out) {
            Pacer pacer;
            std::int64_t degenerate_here = 0;
            for (auto triangle = static_cast<std::int32_t>(begin); triangle < end; ++triangle) {
                const auto corners = surface.mesh.corners(triangle);
                check_inside(corners, cells_per_side);
                const bool degenerate = is_thin(corners, kDegenerate);
                degenerate_here += degenerate ? 1 : 0;
                add_fragments(corners, triangle, degenerate, cells_per_side, out, pacer);
            }
            degenerate_count += degenerate_here;
        });
    surface.degenerate_count = degenerate_count;
    return fragments;
}

}  // namespace

GridMesh to_grid(const SurfaceView& mesh, const Grid& grid) {
    GridMesh result{mesh.triangles, RawVector<Eigen::Vector3d>(mesh.positions.size())};
    parallel_for_rows(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int32_t vertex) {
        result.positions[vertex] = rounded(grid.to_grid(mesh.positions[vertex]));
    });
    return result;
}

ClippedSurface clip_to_grid(const SurfaceView& mesh, const Grid& grid) {
    ClippedSurface surface{grid, to_grid(mesh, grid), {}, 0};
    surface.fragments = list_fragments(surface);
    sort_by(surface.fragments, [](const FragmentEntry& fragment) { return fragment.cell; });
    return surface;
}

}  // namespace tracked_mcf
