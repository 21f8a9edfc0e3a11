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

/// Averages the normals over triangles that share a vertex. A triangle that shares two counts
/// twice.
void average_alike(const Stars& stars, float inverse_square, const Vectors& normals,
                   Vectors& averages) {
    averages.resize(normals.size());
    parallel_for_rows(static_cast<std::int64_t>(normals.size()), [&](std::int32_t i) {
        // The weight is near exp(-x² / 2), without the cost of the exponential function: the fourth
        // power of 1 - x² / 8, where x² is 2 - 2 cos(angle) over the square of the width.
        const float area = normals[i][3];
        Eigen::Vector4f own = inverse_square / 4 * normals[i];
        own[3] = 0;
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (const std::int32_t vertex : stars.triangles[i]) {
            for_each_corner(stars, vertex, [&](std::uint32_t other, std::uint32_t /*corner*/) {
                const Eigen::Vector4f& normal = normals[other];
                const float base = std::max(0.0F, 1 - inverse_square / 4 + own.dot(normal));
                const float square = base * base;
                sum += normal[3] * (square * square) * normal;
            });
        }
        sum[3] = 0;
        averages[i] = sum.normalized();
        averages[i][3] = area;
    });
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

/// Moves the vertices towards the planes through their triangles' centroids with given normals.
/// Only the movements matter, so they are in single precision.
class Fit {
public:
    Fit(const NoisySurface& surface, const Vectors& normals, const Positions& start)
        : surface_(surface),
          normals_(normals),
          start_(start),
          heights_(normals.size()),
          toward_(start.size()),
          moved_(start.size(), Eigen::Vector4f::Zero()),
          next_(start.size()) {
        parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
            Eigen::Vector4f sum = Eigen::Vector4f::Zero();
            for_each_corner(surface.stars, vertex, [&](std::uint32_t triangle, std::uint32_t) {
                const auto [a, b, c] = corners_of(start, surface.stars.triangles[triangle]);
                const Eigen::Vector4f& normal = normals[triangle];
                const Eigen::Vector3d toward = (a + b + c) / 3 - start[vertex];
                sum += static_cast<float>(normal.head<3>().cast<double>().dot(toward)) * normal;
            });
            toward_[vertex] = sum;
        });
    }

    /// Makes an iteration. Returns false and makes none if a vertex would leave the box.
    bool iterate(const Vectors& planes, double sideways, const Eigen::AlignedBox3d& box) {
        const Stars& stars = surface_.stars;
        parallel_for_rows(static_cast<std::int64_t>(heights_.size()), [&](std::int32_t i) {
            const Triangle& t = stars.triangles[i];
            heights_[i] = normals_[i].dot(moved_[t[0]] + moved_[t[1]] + moved_[t[2]]) / 3;
        });
        const auto leaves = [&](std::int64_t row) {
            const auto vertex = static_cast<std::int32_t>(row);
            next_[vertex].setZero();
            if (surface_.is_held(vertex)) return false;
            const Eigen::Vector4f& moved = moved_[vertex];
            Eigen::Vector4f sum = toward_[vertex];
            for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
                const Eigen::Vector4f& normal = normals_[triangle];
                sum += (heights_[triangle] - normal.dot(moved)) * normal;
            });
            const auto triangles =
                static_cast<float>(stars.corner_begin[vertex + 1] - stars.corner_begin[vertex]);
            // No vertex moves farther than it takes to fit.
            const float share = 1 / (triangles * std::max(1.0F, surface_.fidelity[vertex]));
            Eigen::Vector3d position = at(vertex, moved + share * sum);
            limit_sideways(surface_, vertex, planes[vertex], sideways, position);
            next_[vertex].head<3>() = (position - start_[vertex]).cast<float>();
            return !box.contains(position);
        };
        if (parallel_count(stars.count(), leaves) > 0) return false;
        moved_.swap(next_);
        return true;
    }

    Positions positions() const {
        Positions positions(start_.size());
        parallel_for_rows(static_cast<std::int64_t>(positions.size()), [&](std::int32_t vertex) {
            positions[vertex] = at(vertex, moved_[vertex]);
        });
        return positions;
    }

private:
    Eigen::Vector3d at(std::int32_t vertex, const Eigen::Vector4f& moved) const {
        return start_[vertex] + moved.head<3>().cast<double>();
    }

    const NoisySurface& surface_;
    const Vectors& normals_;  ///< of triangles; the fourth component counts for nothing here
    const Positions& start_;
    RawVector<float> heights_;  ///< per triangle: how far its centroid has moved along its normal
    Vectors toward_;            ///< per vertex: sum of the movements to its triangles' planes
    Vectors moved_, next_;      ///< from the start
};

}  // namespace

void sharpen(const NoisySurface& surface, double width, const std::vector<int>& iterations,
             double sideways, const Eigen::AlignedBox3d& box, const Positions& start,
             const std::function<void(std::size_t, Positions)>& take) {
    Vectors normals = normals_of(surface.stars, start);
    const auto inverse_square = static_cast<float>(1 / (width * width));
    int done = 0;
    for (std::size_t i = 0; i < iterations.size(); ++i) {
        for (Vectors averages; done < iterations[i]; ++done) {
            average_alike(surface.stars, inverse_square, normals, averages);
            normals.swap(averages);
        }
        const Vectors planes = means_over_stars(surface.stars, normals);
        Fit fit(surface, normals, start);
        for (int k = 0; k < kFits && fit.iterate(planes, sideways, box);) ++k;
        take(i, fit.positions());
    }
}

}  // namespace tracked_mcf
