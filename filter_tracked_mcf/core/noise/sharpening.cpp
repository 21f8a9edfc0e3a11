// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/sharpening.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// Iterations that fit vertices to normals.
constexpr int kFits = 10;

/// Unit normals of triangles; the fourth component is the area.
Vectors normals_of(const Stars& stars, const Positions& positions) {
    Vectors normals(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(normals.size()), [&](std::int32_t i) {
        const auto [a, b, c] = corners_of(positions, stars.triangles[i]);
        const Eigen::Vector3d twice = twice_vector_area(a, b, c);
        normals[i] << twice.normalized().cast<float>(), static_cast<float>(twice.norm() / 2);
    });
    return normals;
}

/// Returns a weight near exp(-x / 2), without the cost of the exponential function.
float weight_of(float x) {
    const float base = std::max(0.0F, 1 - x / 8);
    const float square = base * base;
    return square * square;
}

/// Averages the normals over triangles that share a vertex. A triangle that shares two counts
/// twice.
void average_alike(const Stars& stars, float inverse_square, const Vectors& normals,
                   Vectors& averages) {
    averages.resize(normals.size());
    parallel_for_rows(static_cast<std::int64_t>(normals.size()), [&](std::int32_t i) {
        const Eigen::Vector4f& own = normals[i];
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (const std::int32_t vertex : stars.triangles[i]) {
            for_each_corner(stars, vertex, [&](std::uint32_t other, std::uint32_t /*corner*/) {
                const Eigen::Vector4f& normal = normals[other];
                const float square = (normal - own).head<3>().squaredNorm();
                sum += normal[3] * weight_of(square * inverse_square) * normal;
            });
        }
        sum[3] = 0;
        averages[i] = sum.normalized();
        averages[i][3] = own[3];
    });
}

/// Returns each vertex moved towards the planes through its triangles' centroids with these
/// normals.
Positions fitted_to(const Vectors& normals, const NoisySurface& surface,
                    const Positions& positions) {
    const Stars& stars = surface.stars;
    Positions fitted(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        fitted[vertex] = positions[vertex];
        if (surface.is_held(vertex)) return;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            const Eigen::Vector3d normal = normals[triangle].head<3>().cast<double>();
            sum += normal.dot((a + b + c) / 3 - positions[vertex]) * normal;
        });
        const auto triangles =
            static_cast<double>(stars.corner_begin[vertex + 1] - stars.corner_begin[vertex]);
        // No vertex moves farther than it takes to fit.
        fitted[vertex] += sum / (triangles * std::max(1.0, double{surface.fidelity[vertex]}));
    });
    return fitted;
}

/// Returns the normals of the vertices: the mean of those of their triangles, weighted by area.
Vectors means_over_stars(const Stars& stars, const Vectors& normals) {
    Vectors means(static_cast<std::size_t>(stars.count()));
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            sum += normals[triangle][3] * normals[triangle];
        });
        sum[3] = 0;
        means[vertex] = sum.normalized();
    });
    return means;
}

}  // namespace

void sharpen(const NoisySurface& surface, const Sharpening& sharpening, double sideways,
             const Eigen::AlignedBox3d& box, Positions& positions) {
    Vectors normals = normals_of(surface.stars, positions), averages;
    const auto inverse_square = static_cast<float>(1 / (sharpening.width * sharpening.width));
    for (int i = 0; i < sharpening.iterations; ++i) {
        average_alike(surface.stars, inverse_square, normals, averages);
        normals.swap(averages);
    }
    const Vectors planes = means_over_stars(surface.stars, normals);
    for (int i = 0; i < kFits; ++i) {
        Positions fitted = fitted_to(normals, surface, positions);
        const auto leaves = [&](std::int64_t row) {
            const auto vertex = static_cast<std::int32_t>(row);
            limit_sideways(surface, vertex, planes[vertex], sideways, fitted[vertex]);
            return !box.contains(fitted[vertex]);
        };
        if (parallel_count(surface.stars.count(), leaves) > 0) break;
        positions.swap(fitted);
    }
}

}  // namespace tracked_mcf
