// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <algorithm>
#include <cstddef>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Between these sides, volumes, squares of areas and their reciprocals are normal doubles.
constexpr double kSmallestSide = 1e-60;
constexpr double kLargestSide = 1e60;

/// Distance from the origin, in sides, at which doubles resolve the mesh to four digits.
constexpr double kFarthest = 1e12;

Eigen::AlignedBox3d box_of(const SurfaceView& surface) {
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

void check_box(const Eigen::AlignedBox3d& box) {
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
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const SurfaceView& surface) {
    const Eigen::AlignedBox3d box = box_of(surface);
    check_box(box);
    return box;
}

double longest_side(const SurfaceView& surface) {
    return bounding_box(surface).sizes().maxCoeff();
}

Eigen::Vector3d twice_vector_area(const SurfaceView& surface, const Triangle& triangle) {
    return twice_vector_area(surface.positions[triangle[0]], surface.positions[triangle[1]],
                             surface.positions[triangle[2]]);
}

bool is_thin(const std::array<Eigen::Vector3d, 3>& corners, double ratio) {
    const auto& [a, b, c] = corners;
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double least = 2 * ratio * longest;
    return twice_vector_area(a, b, c).squaredNorm() <= least * least;
}

std::int64_t count_degenerate(const SurfaceView& surface) {
    return std::count_if(surface.triangles.begin(), surface.triangles.end(),
                         [&](const Triangle& triangle) {
                             return is_thin(corners_of(surface.positions, triangle), kDegenerate);
                         });
}

double surface_area(const SurfaceView& surface, const Selection& selection) {
    double twice = 0;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        twice += twice_vector_area(surface, surface.triangles[i]).norm();
    }
    return 0.5 * twice;
}

double mean_edge_length(const SurfaceView& surface, const Selection& selection) {
    const auto count = static_cast<std::int64_t>(surface.triangles.size());
    const auto is_selected = [&](std::int64_t i) { return selection.empty() || selection[i] != 0; };
    const double perimeters = parallel_sum(count, 0.0, [&](std::int64_t begin, std::int64_t end) {
        double sum = 0;
        for (std::int64_t i = begin; i < end; ++i) {
            if (!is_selected(i)) continue;
            const auto [a, b, c] = corners_of(surface.positions, surface.triangles[i]);
            sum += (b - a).norm() + (c - b).norm() + (a - c).norm();
        }
        return sum;
    });
    const std::int64_t triangles = parallel_count(count, is_selected);
    return triangles == 0 ? 0 : perimeters / static_cast<double>(3 * triangles);
}

// The volume is summed relative to a vertex, so that a surface far from the origin loses no digits.
double enclosed_volume(const SurfaceView& surface) {
    const Eigen::Vector3d& near = surface.positions[surface.triangles.front()[0]];
    double six_times = 0;
    for (const Triangle& triangle : surface.triangles) {
        six_times +=
            (surface.positions[triangle[0]] - near).dot(twice_vector_area(surface, triangle));
    }
    return six_times / 6;
}

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d mean(const Corners& vectors) {
    return (vectors[0] + vectors[1] + vectors[2]) / 3;
}

Corners difference(const Corners& a, const Corners& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Corners midpoints(const Corners& a, const Corners& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

Eigen::Vector3d vector_area(const Corners& c) {
    return twice_vector_area(c[0], c[1], c[2]) / 2;
}

/// Returns the rate of vector_area().
Eigen::Vector3d vector_area_rate(const Corners& c, const Corners& velocities) {
    const auto& [va, vb, vc] = velocities;
    return ((vb - va).cross(c[2] - c[0]) + (c[1] - c[0]).cross(vc - va)) / 2;
}

/// Returns the mean of vector_area() over the motion. It is a quadratic polynomial of time, for
/// which Simpson's rule is exact.
Eigen::Vector3d mean_vector_area(const Corners& initial, const Corners& present) {
    return (vector_area(initial) + 4 * vector_area(midpoints(initial, present)) +
            vector_area(present)) /
           6;
}

}  // namespace

double swept_volume(const Corners& initial, const Corners& present) {
    return mean(difference(present, initial)).dot(mean_vector_area(initial, present));
}

double swept_volume_rate(const Corners& initial, const Corners& present,
                         const Corners& velocities) {
    // The midpoints move at half the velocities.
    const Eigen::Vector3d mean_rate =
        (2 * vector_area_rate(midpoints(initial, present), velocities) +
         vector_area_rate(present, velocities)) /
        6;
    return mean(velocities).dot(mean_vector_area(initial, present)) +
           mean(difference(present, initial)).dot(mean_rate);
}

std::vector<double> along_normals(const std::vector<Eigen::Vector3d>& vectors,
                                  const SurfaceView& surface, const Selection& selection) {
    const std::vector<std::int32_t> welded = weld_coincident_vertices(surface);
    std::vector<Eigen::Vector3d> normals(welded.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        const Eigen::Vector3d normal = twice_vector_area(surface, surface.triangles[i]);
        for (const std::int32_t vertex : surface.triangles[i]) normals[welded[vertex]] += normal;
    }
    std::vector<double> components(welded.size());
    for (std::size_t i = 0; i < components.size(); ++i) {
        // The vector of a vertex that no triangle uses may be a NaN.
        const Eigen::Vector3d& normal = normals[welded[i]];
        if (!normal.isZero(0)) components[i] = normal.stableNormalized().dot(vectors[i]);
    }
    return components;
}

std::vector<double> displacements_along_normals(const TriangleMesh& before,
                                                const std::vector<Eigen::Vector3d>& after,
                                                const Selection& selection) {
    std::vector<Eigen::Vector3d> displacements(after.size());
    for (std::size_t i = 0; i < after.size(); ++i)
        displacements[i] = after[i] - before.positions[i];
    return along_normals(displacements, {after, before.triangles}, selection);
}

}  // namespace tracked_mcf
