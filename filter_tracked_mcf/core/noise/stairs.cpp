// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/stairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/relief.h"

namespace tracked_mcf {

namespace {

/// Stairs have at least so many triangles, and all but a few of these in so many directions. Two
/// normals have the same direction if their coordinates, times kUnits, round to the same integers.
constexpr std::size_t kLeastTriangles = 1000, kDirections = 26;
constexpr double kUnits = 200, kLeastCovered = 0.95;
/// A direction counts if it has this share of the triangles, and planes are different if they are
/// so far from each other, in edges.
constexpr double kLeastShare = 0.01, kLeastGap = 0.02;
/// The planes of one direction, at least; so near to each other in one of the directions, in edges.
/// A real part with steps has its steps farther apart.
constexpr std::size_t kLeastPlanes = 3;
constexpr double kNearPlanes = 1;
/// Stairs are certain if at least so many directions have many planes each, this share of whose
/// gaps are multiples of one gap, up to the tolerance; and if no edge in them is longer than so
/// many mean edges. A plate with studs has only two such directions.
constexpr std::size_t kEvenDirections = 3, kManyPlanes = 10;
constexpr double kLeastEven = 0.9, kToleranceOfGaps = 0.05, kLongestEdge = 3.6;

/// Where the planes of triangles are along a direction, per direction; opposite ones are the same.
using Offsets = std::map<std::array<int, 3>, std::vector<double>>;

Offsets offsets_of(const NoisySurface& surface) {
    Offsets offsets;
    for (const Triangle& t : surface.stars.triangles) {
        const auto [a, b, c] = corners_of(surface.positions, t);
        const Eigen::Vector3d normal = twice_vector_area(a, b, c).normalized();
        std::array<int, 3> direction, opposite;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            direction[axis] =
                static_cast<int>(std::lround(kUnits * normal[static_cast<Eigen::Index>(axis)]));
            opposite[axis] = -direction[axis];
        }
        const double sign = direction < opposite ? -1 : 1;
        offsets[std::max(direction, opposite)].push_back(sign * normal.dot(a + b + c) / 3);
        // A smooth surface has too many directions.
        if (offsets.size() > surface.stars.triangles.size() / 4 + kDirections) return {};
    }
    return offsets;
}

/// The planes of one direction: their number, and whether their distances are multiples of the
/// least one. `distance` is the least one then, or else the median.
struct Planes {
    std::size_t count = 0;
    double distance = 0;
    bool are_even = false;
};

Planes planes_of(std::vector<double> offsets) {
    std::sort(offsets.begin(), offsets.end());
    std::vector<double> gaps;
    for (std::size_t i = 1; i < offsets.size(); ++i) {
        const double gap = offsets[i] - offsets[i - 1];
        if (gap > kLeastGap) gaps.push_back(gap);
    }
    if (gaps.empty()) return {1, 0, false};
    std::sort(gaps.begin(), gaps.end());
    const auto even = std::count_if(gaps.begin(), gaps.end(), [&](double gap) {
        const double ratio = gap / gaps.front();
        return std::abs(ratio - std::round(ratio)) < kToleranceOfGaps;
    });
    const bool are_even =
        static_cast<double>(even) >= kLeastEven * static_cast<double>(gaps.size());
    return {gaps.size() + 1, are_even ? gaps.front() : gaps[gaps.size() / 2], are_even};
}

}  // namespace

Stairs stairs_of(const NoisySurface& surface) {
    const std::size_t count = surface.stars.triangles.size();
    if (count < kLeastTriangles) return {};
    std::vector<std::pair<Planes, std::size_t>> directions;  // with their triangles
    for (auto& [direction, offsets] : offsets_of(surface)) {
        const std::size_t triangles = offsets.size();
        directions.emplace_back(planes_of(std::move(offsets)), triangles);
    }
    std::sort(directions.begin(), directions.end(),
              [](const auto& a, const auto& b) { return a.second > b.second; });
    directions.resize(std::min(directions.size(), kDirections));
    std::size_t covered = 0, even = 0;
    double nearest = 2 * kNearPlanes, farthest = 0;
    for (const auto& [planes, triangles] : directions) {
        covered += triangles;
        const double share = static_cast<double>(triangles) / static_cast<double>(count);
        // Two flat sides are as far from each other as the part is thick.
        if (share < kLeastShare || planes.count < kLeastPlanes) continue;
        if (planes.are_even && planes.count >= kManyPlanes) ++even;
        nearest = std::min(nearest, planes.distance);
        farthest = std::max(farthest, planes.distance);
    }
    if (static_cast<double>(covered) < kLeastCovered * static_cast<double>(count) ||
        nearest > kNearPlanes)
        return {};
    const Relief relief = relief_of(surface, whole_of(surface));
    if (!relief.is_relief) return {};
    return {farthest, even >= kEvenDirections && relief.longest_edge <= kLongestEdge};
}

}  // namespace tracked_mcf
