// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <algorithm>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Between these sides, volumes, squares of areas and their reciprocals are normal doubles.
constexpr double kSmallestSide = 1e-60;
constexpr double kLargestSide = 1e60;

/// Distance from the origin, in sides, at which doubles resolve the mesh to four digits.
constexpr double kFarthestFromOrigin = 1e12;

}  // namespace

void check_box(const Eigen::AlignedBox3d& box) {
    const double side = box.sizes().maxCoeff();
    if (!(side >= kSmallestSide && side <= kLargestSide)) {
        throw InvalidMesh(
            "The mesh is too large or too small to compute with; scale it so that its "
            "bounding box has sides between 1e-60 and 1e60.");
    }
    if (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() >
        kFarthestFromOrigin * side) {
        throw InvalidMesh(
            "The mesh lies so far from the origin that its coordinates cannot tell its "
            "vertices apart; move it to the origin.");
    }
}

double mean_edge_length(const TriangleMesh& mesh, const Selection& selection) {
    const auto counts = [&](std::int64_t i) {
        if (!selection.empty() && selection[i] == 0) return false;
        const auto [a, b, c] = corners_of(mesh.positions, mesh.triangles[i]);
        return a != b && b != c && c != a;
    };
    const auto count = static_cast<std::int64_t>(mesh.triangles.size());
    const double perimeters = parallel_sum(count, 0.0, [&](std::int64_t begin, std::int64_t end) {
        double sum = 0;
        for (std::int64_t i = begin; i < end; ++i) {
            if (counts(i)) sum += perimeter(corners_of(mesh.positions, mesh.triangles[i]));
        }
        return sum;
    });
    const std::int64_t triangles = parallel_count(count, counts);
    return triangles == 0 ? 0 : perimeters / static_cast<double>(3 * triangles);
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

}  // namespace tracked_mcf
