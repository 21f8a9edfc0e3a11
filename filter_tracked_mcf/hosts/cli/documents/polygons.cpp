// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/polygons.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tracked_mcf {

namespace {

/// Returns the normal of a triangle, twice as long as its area; zero if rounding its coordinates to
/// this relative precision may flatten it.
Eigen::Vector3d area_vector(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                            const Eigen::Vector3d& r, double precision) {
    const Eigen::Vector3d area = (q - p).cross(r - p);
    const double largest = p.cwiseAbs().cwiseMax(q.cwiseAbs()).cwiseMax(r.cwiseAbs()).maxCoeff();
    const double base =
        std::max({(q - p).stableNorm(), (r - p).stableNorm(), (r - q).stableNorm()});
    // Rounding moves each end of two edges.
    return area.stableNorm() > 4 * precision * largest * base ? area : Eigen::Vector3d::Zero();
}

}  // namespace

std::vector<Triangle> fans(const Polygons& polygons) {
    std::vector<Triangle> triangles;
    triangles.reserve(polygons.corners.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const std::int32_t* const corners = polygons.corners.data() + polygons.first[i];
        for (std::size_t k = 2; k < polygons.corner_count(i); ++k) {
            triangles.push_back({corners[0], corners[k - 1], corners[k]});
        }
    }
    return triangles;
}

Points moved_normals(const Points& before, const Points& after, double precision,
                     const Polygons& polygons, const std::vector<std::int32_t>& normal_of_corner,
                     std::size_t count) {
    Points normals(count, Eigen::Vector3d::Zero());
    std::vector<bool> has_moved(count, false);
    for (std::size_t i = 0; i < polygons.size() && count > 0; ++i) {
        const std::size_t begin = polygons.first[i], end = polygons.first[i + 1];
        const auto point = [&](const Points& points, std::size_t c) -> const Eigen::Vector3d& {
            return points[static_cast<std::size_t>(polygons.corners[c])];
        };
        Eigen::Vector3d area = Eigen::Vector3d::Zero();
        bool moves = false;
        for (std::size_t c = begin; c < end; ++c) {
            moves = moves || point(after, c) != point(before, c);
            if (c < begin + 2) continue;
            area +=
                area_vector(point(after, begin), point(after, c - 1), point(after, c), precision);
        }
        for (std::size_t c = begin; c < end && !area.isZero(0); ++c) {
            if (normal_of_corner[c] < 0) continue;
            const auto normal = static_cast<std::size_t>(normal_of_corner[c]);
            normals[normal] += area;
            has_moved[normal] = has_moved[normal] || moves;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        // stableNormalize leaves zero vectors alone and does not underflow for tiny models.
        if (!has_moved[i]) normals[i].setZero();
        normals[i].stableNormalize();
    }
    return normals;
}

}  // namespace tracked_mcf
