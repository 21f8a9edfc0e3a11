// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// This share of the area that is in no flat side faces to one side, and its vector sum has this
/// share of it.
constexpr double kFacing = 0.99, kLeastFacing = 0.3;

/// Two normals have the same direction if their coordinates, times this, round to the same
/// integers.
constexpr double kUnitsOfDirections = 200;

/// The planes of a flat side, at most, and how near offsets of one plane are, in edges.
constexpr std::size_t kMostPlanes = 2;
constexpr double kSamePlane = 0.02;

/// The triangles of one direction.
struct Facing {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of vector areas
    double longest_edge = 0;
    std::vector<double> planes;  ///< offsets, up to one more than those of a flat side

    bool is_flat_side() const { return planes.size() <= kMostPlanes; }
    void add_plane(double offset) {
        const bool is_new = std::none_of(planes.begin(), planes.end(), [&](double plane) {
            return std::abs(plane - offset) <= kSamePlane;
        });
        if (is_new && is_flat_side()) planes.push_back(offset);
    }
};

}  // namespace

Relief relief_of(const NoisySurface& surface, const PartRange& part) {
    std::map<std::array<std::int64_t, 3>, Facing> directions;
    for (std::int64_t i = part.first_triangle; i < part.end_triangle; ++i) {
        const auto [a, b, c] = corners_of(surface.positions, surface.stars.triangles[i]);
        const Eigen::Vector3d area = twice_vector_area(a, b, c), normal = area.normalized();
        const Eigen::Vector3d units = kUnitsOfDirections * normal;
        Facing& facing =
            directions[{std::lround(units[0]), std::lround(units[1]), std::lround(units[2])}];
        facing.sum += area;
        facing.longest_edge =
            std::max({facing.longest_edge, (a - b).norm(), (b - c).norm(), (c - a).norm()});
        facing.add_plane(normal.dot(a + b + c) / 3);
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [direction, facing] : directions) {
        if (!facing.is_flat_side()) sum += facing.sum;
    }
    Relief relief;
    double to_one_side = 0, area = 0;
    for (const auto& [direction, facing] : directions) {
        if (facing.is_flat_side()) continue;
        relief.longest_edge = std::max(relief.longest_edge, facing.longest_edge);
        area += facing.sum.norm();
        if (facing.sum.dot(sum) > 0) to_one_side += facing.sum.norm();
    }
    relief.is_relief = to_one_side > kFacing * area && sum.norm() > kLeastFacing * area;
    return relief;
}

}  // namespace tracked_mcf
