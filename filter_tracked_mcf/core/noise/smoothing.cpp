// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/smoothing.h"

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// The normals of a star cancel each other if their squared sum is below this share of the sum of
/// their squares.
constexpr double kOppositeNormals = 1e-20;

}  // namespace

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
        iterations_ += elements_.smooth(settings.normal_step_size, vectors_, normals_);
        parallel_for_rows(stars.count(),
                          [&](std::int32_t vertex) { normals_[vertex].normalize(); });
    }
    return normals_;
}

bool Smoothing::step(const StepSettings& settings, const Eigen::AlignedBox3d& box,
                     Positions& positions) {
    elements_.assemble(smooth_normals(positions, settings), settings.normal_length, &positions);
    iterations_ += elements_.displace(settings.step_size, positions, vectors_);
    const auto moved = [&](std::int32_t vertex) -> Eigen::Vector3d {
        return positions[vertex] + vectors_[vertex].head<3>().cast<double>();
    };
    const auto leaves = [&](std::int64_t i) {
        return !box.contains(moved(static_cast<std::int32_t>(i)));
    };
    if (parallel_count(surface_.stars.count(), leaves) > 0) return false;
    parallel_for_rows(surface_.stars.count(),
                      [&](std::int32_t vertex) { positions[vertex] = moved(vertex); });
    return true;
}

}  // namespace tracked_mcf
