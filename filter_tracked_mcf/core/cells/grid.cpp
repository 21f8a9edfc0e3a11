// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/cells/grid.h"

#include <Eigen/Geometry>
#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Side of the cube over the longest side of the model. The margin keeps the model off the cube's
/// faces.
constexpr double kCubeToModel = 1.1;

/// Between these sides, volumes, squares of areas and their reciprocals are normal doubles.
constexpr double kSmallestSide = 1e-60;
constexpr double kLargestSide = 1e60;

/// Distance from the origin, in sides, at which doubles resolve the mesh to four digits.
constexpr double kFarthest = 1e12;

Eigen::AlignedBox3d bounding_box(const SurfaceView& surface) {
    const auto count = static_cast<std::int64_t>(surface.triangles.size());
    std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(chunk_count(count)));
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        Eigen::AlignedBox3d& box = boxes[begin / kChunkSize];
        for (std::int64_t i = begin; i < end; ++i) {
            for (const std::int32_t vertex : surface.triangles[i])
                box.extend(surface.positions[vertex]);
        }
    });
    Eigen::AlignedBox3d all;
    for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
    return all;
}

double checked_longest_side(const Eigen::AlignedBox3d& box) {
    const double side = box.sizes().maxCoeff();
    if (side == 0) {
        throw InvalidMesh("All faces are degenerate: every vertex lies at the same point.");
    }
    if (!(side >= kSmallestSide && side <= kLargestSide)) {
        throw InvalidMesh(
            "The mesh is too large or too small to compute with; scale it so that its "
            "bounding box has sides between 1e-60 and 1e60.");
    }
    if (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() > kFarthest * side) {
        throw InvalidMesh(
            "The mesh lies so far from the origin that its coordinates cannot tell its "
            "vertices apart; move it to the origin.");
    }
    return side;
}

}  // namespace

double longest_side(const SurfaceView& surface) {
    return checked_longest_side(bounding_box(surface));
}

Grid enclosing_grid(const SurfaceView& surface, int depth) {
    const Eigen::AlignedBox3d box = bounding_box(surface);
    const double cube_side = kCubeToModel * checked_longest_side(box);
    const Eigen::Vector3d origin = box.center() - Eigen::Vector3d::Constant(0.5 * cube_side);
    return with_depth({origin, cube_side, 0}, depth);
}

Grid with_depth(const Grid& grid, int depth) {
    return {grid.origin, std::ldexp(grid.cell_size, grid.depth - depth), depth};
}

}  // namespace tracked_mcf
