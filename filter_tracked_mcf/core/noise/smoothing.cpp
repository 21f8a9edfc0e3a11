// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/smoothing.h"

#include <Eigen/Geometry>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

const Vectors& Smoothing::smooth_normals(const Positions& positions, const StepSettings& settings) {
    const Stars& stars = surface_.stars;
    averages_.resize(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            sum += twice_vector_area(a, b, c);
        });
        averages_[vertex] << sum.normalized().cast<float>(), 0;
    });
    normals_ = averages_;
    for (const double normal_length : {0.0, settings.normal_length}) {
        elements_.assemble(normals_, normal_length);
        iterations_ += elements_.smooth(settings.normal_step_size, averages_, normals_);
        parallel_for_rows(stars.count(),
                          [&](std::int32_t vertex) { normals_[vertex].normalize(); });
    }
    return normals_;
}

void Smoothing::step(const StepSettings& settings, Positions& positions) {
    elements_.assemble(smooth_normals(positions, settings), settings.normal_length);
    iterations_ += elements_.displace(settings.step_size, positions, displacements_);
    parallel_for_rows(surface_.stars.count(), [&](std::int32_t vertex) {
        positions[vertex] += displacements_[vertex].head<3>().cast<double>();
    });
}

}  // namespace tracked_mcf
