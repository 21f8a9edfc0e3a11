// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/losses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// A part that loses more than this has lost more than noise, and is folded if more than this share
/// of its area is, and more triangles than so many.
constexpr double kTooMuch = 0.03, kMostTurned = 0.005;
constexpr std::int64_t kFewTriangles = 3;
constexpr double kStandardErrors = 3, kShareOfNoise = 0.2;
/// A part is closed if the sum of its triangles' normals is less than this, relative to its area.
constexpr double kClosed = 1e-9;

/// A part is flat if its volume is less than this, relative to its area to the power 3/2; 0.09 of a
/// sphere.
constexpr double kFlat = 1e-6;
/// Parts smaller than this many roundings of a position are not measured.
constexpr double kSmallest = 1e4;
/// A triangle has collapsed if less than this share of its area is left. Its movement tells nothing
/// of how the surface around it lies.
constexpr double kCollapsedShare = 1e-3;

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

/// Sums over the triangles of a part; areas and volumes are 2 and 6 times as large.
struct Part {
    Eigen::Vector3d origin;  ///< a corner, so that small parts far away cancel nothing
    Spread before, after;    ///< of the corners
    double area_before = 0, area_after = 0;  ///< see losses_of()
    double volume_before = 0, volume_after = 0;
    double area = 0, turned_area = 0, squares_of_movements = 0;
    std::int64_t triangles = 0, turned = 0;
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

    PartLoss loss(double rounding) const {
        PartLoss loss;
        if (!is_measurable(rounding)) return loss;
        loss.area = lost_area();
        loss.area_of_noise = kShareOfNoise * std::max(0.0, 1 - area_before / area);
        loss.turned = turned;
        loss.turned_area = turned_area / area;
        if (!has_volume()) return loss;
        loss.volume = std::abs(volume_after / volume_before - 1);
        // A closed part has half as many vertices as triangles.
        const double movement = std::sqrt(squares_of_movements / before.count),
                     vertices = 0.5 * static_cast<double>(triangles);
        loss.volume_of_noise =
            kStandardErrors * 3 * area * movement / std::sqrt(vertices) / std::abs(volume_before);
        return loss;
    }
};

/// Returns per vertex the sum of twice the vector areas of its star.
Positions star_vectors(const Stars& stars, const Positions& positions) {
    Positions vectors(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            sum += twice_vector_area(a, b, c);
        });
        vectors[vertex] = sum;
    });
    return vectors;
}

std::vector<Part> parts_of(const Surface& before, const Positions& after) {
    const Stars& stars = before.stars;
    const Positions vectors_before = star_vectors(stars, before.positions),
                    vectors_after = star_vectors(stars, after);
    std::vector<Part> parts(static_cast<std::size_t>(before.part_count));
    for (std::size_t i = 0; i < stars.triangles.size(); ++i) {
        const Triangle& t = stars.triangles[i];
        const auto around = [&](const Positions& vectors) -> Eigen::Vector3d {
            return (vectors[t[0]] + vectors[t[1]] + vectors[t[2]]).normalized();
        };
        Part& part = parts[before.parts[t[0]]];
        if (part.triangles == 0) part.origin = before.positions[t[0]];
        auto [a, b, c] = corners_of(before.positions, t);
        auto [p, q, r] = corners_of(after, t);
        for (Eigen::Vector3d* const corner : {&a, &b, &c, &p, &q, &r}) *corner -= part.origin;
        const Eigen::Vector3d old = twice_vector_area(a, b, c),
                              present = twice_vector_area(p, q, r), normal = around(vectors_after);
        const bool has_collapsed = !(present.norm() > kCollapsedShare * old.norm());
        const double seen = old.dot(normal);
        for (const Eigen::Vector3d& corner : {a, b, c}) part.before.add(corner);
        for (const Eigen::Vector3d& corner : {p, q, r}) part.after.add(corner);
        part.squares_of_movements +=
            (p - a).squaredNorm() + (q - b).squaredNorm() + (r - c).squaredNorm();
        part.area += old.norm();
        part.area_before += has_collapsed ? old.norm() : seen;
        part.area_after += present.dot(normal);
        ++part.triangles;
        if (present.dot(normal) < 0 && seen > 0 && old.dot(around(vectors_before)) > 0) {
            ++part.turned;
            part.turned_area += old.norm();
        }
        part.normals += old;
        part.volume_before += a.dot(old);
        part.volume_after += p.dot(present);
        for (std::size_t side = 0; side < 3 && stars.has_rim(); ++side) {
            if (stars.rim_sides[3 * i + side] != 0) part.has_rim = true;
        }
    }
    return parts;
}

}  // namespace

bool PartLoss::is_too_much() const {
    const bool is_folded = turned > kFewTriangles && turned_area > kMostTurned;
    return is_folded || area > kTooMuch + area_of_noise || volume > kTooMuch + volume_of_noise;
}

std::vector<PartLoss> losses_of(const Surface& before, const Positions& after, double rounding) {
    std::vector<PartLoss> losses;
    for (const Part& part : parts_of(before, after)) losses.push_back(part.loss(rounding));
    return losses;
}

}  // namespace tracked_mcf
