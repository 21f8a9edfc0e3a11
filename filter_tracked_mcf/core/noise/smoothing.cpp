// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/smoothing.h"

#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// The reductions of the error of smooth normals, from the mean normals of the stars in the first
/// metric, and from there in the second one. The metric averages normals over triangles, but with
/// 0.2 for either, other candidates win on fandisk and anchor_dense, whose angles are 5 % worse.
constexpr double kReductionOfNormals = 0.08, kFurtherReduction = 0.1;

/// The normals of a star cancel each other if their squared sum is below this share of the sum of
/// their squares.
constexpr float kOppositeNormals = 1e-11F;

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

void limit_sideways(const NoisySurface& surface, std::int32_t vertex, const Eigen::Vector4f& plane,
                    double sideways, Eigen::Vector3d& position) {
    if (std::isinf(sideways)) return;
    const std::vector<std::uint8_t>& on_rim = surface.stars.on_rim;
    const Eigen::Vector3d normal = plane.head<3>().cast<double>();
    const Eigen::Vector3d moved = position - surface.positions[vertex];
    const Eigen::Vector3d aside = moved - moved.dot(normal) * normal;
    double most = on_rim.empty() || on_rim[vertex] == 0 ? sideways : 0;
    const double square = aside.squaredNorm();
    if (square <= most * most) return;
    if (is_folded(surface, vertex, normal)) most *= kFolded;
    const double length = std::sqrt(square);
    if (length > most) position -= (1 - most / length) * aside;
}

const Vectors& Smoothing::smooth_normals(const Positions& positions, const StepSettings& settings) {
    const Stars& stars = surface_.stars;
    triangle_normals_.resize(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(stars.triangles.size()), [&](std::int32_t i) {
        const auto [a, b, c] = corners_of(positions, stars.triangles[i]);
        triangle_normals_[i] << twice_vector_area(a, b, c).cast<float>(), 0;
    });
    vectors_.resize(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        float squares = 0;
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            sum += triangle_normals_[triangle];
            squares += triangle_normals_[triangle].squaredNorm();
        });
        // What is left where two sides of a sheet cancel is rounding.
        if (!(sum.squaredNorm() > kOppositeNormals * squares)) sum.setZero();
        vectors_[vertex] = sum.normalized();
    });
    const auto normalise = [&] {
        parallel_for_rows(stars.count(),
                          [&](std::int32_t vertex) { normals_[vertex].normalize(); });
    };
    const double size = settings.normal_step_size;
    normals_ = vectors_;
    iterations_ += elements_.smooth_evenly(size, vectors_, kReductionOfNormals, normals_);
    normalise();
    if (settings.normal_length > 0) {
        elements_.assemble(normals_, settings.normal_length, size);
        iterations_ += elements_.smooth(vectors_, kFurtherReduction, normals_);
    } else {
        iterations_ += elements_.smooth_evenly(size, vectors_, kFurtherReduction, normals_);
    }
    normalise();
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
    elements_.assemble(smooth_normals(positions, settings), settings.normal_length,
                       settings.step_size, &positions);
    const Vectors& planes = normals_of_planes();
    iterations_ += elements_.displace(positions, planes, heights, vectors_);
    const auto leaves = [&](std::int64_t i) {
        const auto vertex = static_cast<std::int32_t>(i);
        Eigen::Vector3d moved = positions[vertex] + vectors_[vertex].head<3>().cast<double>();
        limit_sideways(surface_, vertex, planes[vertex], settings.sideways, moved);
        vectors_[vertex].head<3>() = (moved - positions[vertex]).cast<float>();
        return !box.contains(moved);
    };
    if (parallel_count(surface_.stars.count(), leaves) > 0) return false;
    parallel_for_rows(surface_.stars.count(), [&](std::int32_t vertex) {
        positions[vertex] += vectors_[vertex].head<3>().cast<double>();
        if (!heights.empty()) heights[vertex] += vectors_[vertex][3];
    });
    return true;
}

}  // namespace tracked_mcf
