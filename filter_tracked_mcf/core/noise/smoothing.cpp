// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/smoothing.h"

#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// The accuracy of smooth normals: the metric averages them over triangles.
constexpr double kToleranceOfNormals = 2e-2;

/// The normals of a star cancel each other if their squared sum is below this share of the sum of
/// their squares.
constexpr double kOppositeNormals = 1e-20;

/// A vertex may go so many times as far sideways if its star was folded, in order to unfold it.
constexpr double kFolded = 2;

/// Returns whether a triangle of a vertex's star, before it has moved, has its back to a normal.
bool is_folded(const NoisySurface& surface, std::int32_t vertex, const Eigen::Vector3d& normal) {
    bool folded = false;
    for_each_corner(surface.stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
        const auto [a, b, c] = corners_of(surface.positions, surface.stars.triangles[triangle]);
        folded |= twice_vector_area(a, b, c).dot(normal) < 0;
    });
    return folded;
}

}  // namespace

void limit_sideways(const NoisySurface& surface, const Vectors& normals, double sideways,
                    Positions& positions) {
    if (std::isinf(sideways)) return;
    const std::vector<std::uint8_t>& on_rim = surface.stars.on_rim;
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        const Eigen::Vector3d normal = normals[vertex].head<3>().cast<double>();
        const Eigen::Vector3d moved = positions[vertex] - surface.positions[vertex];
        const Eigen::Vector3d aside = moved - moved.dot(normal) * normal;
        double most = on_rim.empty() || on_rim[vertex] == 0 ? sideways : 0;
        const double length = aside.norm();
        if (length > most && is_folded(surface, vertex, normal)) most *= kFolded;
        if (length > most) positions[vertex] -= (1 - most / length) * aside;
    });
}

const Vectors& Smoothing::smooth_normals(const Positions& positions, const StepSettings& settings) {
    const Stars& stars = surface_.stars;
    vectors_.resize(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double squares = 0;
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            const Eigen::Vector3d area = twice_vector_area(a, b, c);
            sum += area;
            squares += area.squaredNorm();
        });
        // What is left where two sides of a sheet cancel is rounding.
        if (!(sum.squaredNorm() > kOppositeNormals * squares)) sum.setZero();
        vectors_[vertex] << sum.normalized().cast<float>(), 0;
    });
    normals_ = vectors_;
    for (const double normal_length : {0.0, settings.normal_length}) {
        elements_.assemble(normals_, normal_length);
        iterations_ +=
            elements_.smooth(settings.normal_step_size, vectors_, kToleranceOfNormals, normals_);
        parallel_for_rows(stars.count(),
                          [&](std::int32_t vertex) { normals_[vertex].normalize(); });
    }
    return normals_;
}

/// Returns the normals of the vertices' tangent planes: the smooth normals, but on a rim the means
/// over the stars of the vertex and its neighbours on the rim. Smooth normals are those of places
/// farther inside.
const Vectors& Smoothing::normals_of_planes() {
    const Stars& stars = surface_.stars;
    if (stars.on_rim.empty()) return normals_;
    planes_ = normals_;
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        if (stars.on_rim[vertex] == 0) return;
        Eigen::Vector4f sum = vectors_[vertex];
        for_each_rim_neighbour(stars, vertex,
                               [&](std::int32_t neighbour) { sum += vectors_[neighbour]; });
        planes_[vertex] = sum.normalized();
    });
    return planes_;
}

bool Smoothing::step(const StepSettings& settings, const Eigen::AlignedBox3d& box,
                     Positions& positions, std::vector<float>& heights) {
    elements_.assemble(smooth_normals(positions, settings), settings.normal_length, &positions);
    const Vectors& planes = normals_of_planes();
    iterations_ += elements_.displace(settings.step_size, positions, planes, heights, vectors_);
    Positions moved(positions.size());
    parallel_for_rows(surface_.stars.count(), [&](std::int32_t vertex) {
        moved[vertex] = positions[vertex] + vectors_[vertex].head<3>().cast<double>();
    });
    limit_sideways(surface_, planes, settings.sideways, moved);
    const auto leaves = [&](std::int64_t vertex) { return !box.contains(moved[vertex]); };
    if (parallel_count(surface_.stars.count(), leaves) > 0) return false;
    positions.swap(moved);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] += vectors_[i][3];
    return true;
}

}  // namespace tracked_mcf
