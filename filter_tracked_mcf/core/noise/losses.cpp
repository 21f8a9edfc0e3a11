// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/losses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

namespace tracked_mcf {

namespace {

/// A part that loses more than this has lost more than noise.
constexpr double kTooMuch = 0.03;
/// A part is closed if the sum of its triangles' normals is less than this, relative to its area.
constexpr double kClosed = 1e-9;

/// A part is flat if its volume is less than this, relative to its area to the power 3/2; 0.09 of a
/// sphere.
constexpr double kFlat = 1e-6;
/// Parts smaller than this many roundings of a position are not measured.
constexpr double kSmallest = 1e4;
/// A triangle has collapsed if less than this share of its area is left. It has no direction then.
constexpr double kCollapsed = 1e-3;

/// The spread of points around their mean.
struct Spread {
    double count = 0, squares = 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();

    void add(const Eigen::Vector3d& point) {
        ++count;
        squares += point.squaredNorm();
        sum += point;
    }
    /// Returns the mean squared distance from the mean.
    double square() const { return squares / count - (sum / count).squaredNorm(); }
};

/// Sums over the triangles of a part.
struct Part {
    Spread before, after;                    ///< of the corners
    double area_before = 0, area_after = 0;  ///< see losses_of()
    double volume_before = 0, volume_after = 0;
    double area = 0;
    Eigen::Vector3d normals = Eigen::Vector3d::Zero();
    bool has_rim = false;

    /// Returns the share of the area that the part has lost. Where it has collapsed, the triangles
    /// have no direction to be seen along, so its spread is compared, too.
    double lost_area() const {
        const double lost = area_before > 0 ? 1 - area_after / area_before : 0;
        const double narrower = before.square() > 0 ? 1 - after.square() / before.square() : 0;
        return std::clamp(std::max(lost, narrower), 0.0, 1.0);
    }

    /// Returns whether the part has a size that positions can tell.
    bool is_measurable(double rounding) const {
        const double square = kSmallest * kSmallest * rounding * rounding;
        return area > square && before.square() > square;
    }
    bool has_volume() const {
        return !has_rim && normals.norm() <= kClosed * area &&
               std::abs(volume_before) > kFlat * std::pow(area, 1.5);
    }
};

std::vector<Part> parts_of(const NoisySurface& before, const Positions& after) {
    const Stars& stars = before.stars;
    ConcurrentSets sets(stars.count());
    parallel_for_items(stars.triangles, [&](const Triangle& t) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
    });
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(stars.count()), -1);
    std::vector<Part> parts;
    for (std::size_t i = 0; i < stars.triangles.size(); ++i) {
        const Triangle& t = stars.triangles[i];
        std::int32_t& number = numbers[sets.find(t[0])];
        if (number < 0) {
            number = static_cast<std::int32_t>(parts.size());
            parts.emplace_back();
        }
        Part& part = parts[number];
        const auto [a, b, c] = corners_of(before.positions, t);
        const auto [p, q, r] = corners_of(after, t);
        const Eigen::Vector3d old = twice_vector_area(a, b, c),
                              present = twice_vector_area(p, q, r);
        const double area = present.norm();
        for (const Eigen::Vector3d& corner : {a, b, c}) part.before.add(corner);
        for (const Eigen::Vector3d& corner : {p, q, r}) part.after.add(corner);
        part.area += old.norm();
        const bool has_collapsed = !(area > kCollapsed * old.norm());
        part.area_before += has_collapsed ? old.norm() : old.dot(present) / area;
        part.area_after += area;
        part.normals += old;
        part.volume_before += a.dot(old);
        part.volume_after += p.dot(present);
        for (std::size_t side = 0; side < 3 && !stars.on_rim.empty(); ++side) {
            if (stars.rim_sides[3 * i + side] != 0) part.has_rim = true;
        }
    }
    return parts;
}

}  // namespace

Losses losses_of(const NoisySurface& before, const Positions& after, double rounding) {
    Losses losses;
    for (const Part& part : parts_of(before, after)) {
        if (!part.is_measurable(rounding)) continue;
        const double area = part.lost_area();
        const double volume =
            part.has_volume() ? std::abs(part.volume_after / part.volume_before - 1) : 0;
        losses.area = std::max(losses.area, area);
        losses.volume = std::max(losses.volume, volume);
        if (std::max(area, volume) > kTooMuch) ++losses.parts;
    }
    return losses;
}

}  // namespace tracked_mcf
