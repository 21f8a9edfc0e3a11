// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/preserving.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// The flow ends if parts of more than this share of the area would be inflated.
constexpr double kMostInflated = 0.5;

/// The volume that a part has swept, relative to its area times its size. Newton's method
/// takes it to the goal in a few steps, unless the flow's step has changed the shape beyond
/// recovery.
constexpr double kGoalOfSwept = 1e-13, kMostSwept = 1e-7;
constexpr int kStepsOfNewton = 10;

/// Parts are specks if they have at most this share of the initial area together.
constexpr double kMostInSpecks = 0.01;

/// A part cannot move if a pressure moves it less than this fraction of what it moves a plane.
constexpr double kHardlyMoves = 1e-9;

/// Returns, for each part, the sum of of_triangle(t) over its triangles.
template <class Value, class OfTriangle>
std::vector<Value> sums_of_parts(const Surface& surface, const OfTriangle& of_triangle) {
    using OfPart = std::pair<std::int32_t, Value>;
    const RawVector<Triangle>& triangles = surface.stars.triangles;
    // Triangles are sorted by part.
    const auto of_chunks = parallel_collect<OfPart>(
        static_cast<std::int64_t>(triangles.size()),
        [&](std::int64_t begin, std::int64_t end, std::vector<OfPart>& out) {
            for (std::int64_t i = begin; i < end; ++i) {
                const std::int32_t part = surface.parts[triangles[i][0]];
                if (out.empty() || out.back().first != part) out.push_back({part, Value()});
                out.back().second += of_triangle(triangles[i]);
            }
        });
    std::vector<Value> sums(static_cast<std::size_t>(surface.part_count));
    for (const auto& [part, sum] : of_chunks) sums[part] += sum;
    return sums;
}

}  // namespace

Preserver::Measures& Preserver::Measures::operator+=(const Measures& other) {
    area += other.area;
    volume += other.volume;
    centroid += other.centroid;
    box.extend(other.box);
    return *this;
}

Preserver::Swept& Preserver::Swept::operator+=(const Swept& other) {
    volume += other.volume;
    rate += other.rate;
    return *this;
}

Preserver::Preserver(const Surface& surface, const TriangleMesh& mesh, const Positions& initial,
                     Preserve kind, FlowKind flow)
    : surface_(surface),
      mesh_(mesh),
      kind_(kind),
      pushes_(kind == Preserve::Volume && flow == FlowKind::MeanCurvature),
      initial_(measure(initial)) {
    const double growth =
        flow == FlowKind::Conformalized ? kLargestConformalizedGrowth : kLargestGrowth;
    for (Measures& part : initial_) {
        const double sphere = std::sqrt(part.area / kPi);
        const double half = growth / 2 * std::max(part.box.sizes().maxCoeff(), sphere);
        part.bounds = {part.box.center().array() - half, part.box.center().array() + half};
    }
}

std::vector<Preserver::Measures> Preserver::measure(const Positions& positions) const {
    // The sums of the centroids are weighted by area.
    auto parts = sums_of_parts<Measures>(surface_, [&](const Triangle& t) {
        const auto [a, b, c] = corners_of(positions, t);
        const Eigen::Vector3d normal = twice_vector_area(a, b, c) / 2;
        Measures of_triangle;
        of_triangle.area = normal.norm();
        of_triangle.volume = a.dot(normal) / 3;
        of_triangle.centroid = of_triangle.area / 3 * (a + b + c);
        for (const Eigen::Vector3d& corner : {a, b, c}) of_triangle.box.extend(corner);
        return of_triangle;
    });
    for (Measures& part : parts) part.centroid /= part.area;
    return parts;
}

void Preserver::pressure(const Positions& positions, Field& pull) const {
    const Stars& stars = surface_.stars;
    pull.resize(4, stars.count());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            sum += twice_vector_area(a, b, c) / 6;
        });
        if (surface_.held[vertex] != 0) sum.setZero();
        pull.col(vertex) << sum.cast<float>(), 0;
    });
}

Stop Preserver::restore(const Positions& response, Positions& positions) const {
    const std::vector<Measures> present = measure(positions);
    double area = 0, initial_area = 0;
    for (std::size_t i = 0; i < present.size(); ++i) {
        area += present[i].area;
        initial_area += initial_[i].area;
    }
    if (!(area > kVanishedArea * initial_area)) return Stop::Vanished;
    const std::optional<double> inflated =
        pushes_ ? push(response, positions) : scale(present, positions);
    if (!inflated) return Stop::NotPreserved;
    return *inflated > kMostInflated * initial_area ? Stop::Pinched : Stop::None;
}

double Preserver::scale(const std::vector<Measures>& present, Positions& positions) const {
    std::vector<double> factors(present.size(), 1);
    double inflated = 0;
    for (std::size_t i = 0; i < present.size(); ++i) {
        const bool by_volume = kind_ == Preserve::Volume;
        const double ratio =
            by_volume ? initial_[i].volume / present[i].volume : initial_[i].area / present[i].area;
        // The ratio is negative if a part has turned inside out.
        const bool vanished = present[i].area <= kVanishedArea * initial_[i].area;
        if (vanished || !(ratio > 0) || !std::isfinite(ratio)) continue;
        const double factor = by_volume ? std::cbrt(ratio) : std::sqrt(ratio);
        const Eigen::Vector3d& centre = present[i].centroid;
        const Eigen::AlignedBox3d scaled(centre + factor * (present[i].box.min() - centre),
                                         centre + factor * (present[i].box.max() - centre));
        if (initial_[i].bounds.contains(scaled)) {
            factors[i] = factor;
        } else {
            inflated += initial_[i].area;
        }
    }
    parallel_for_rows(surface_.stars.count(), [&](std::int32_t vertex) {
        const std::int32_t part = surface_.parts[vertex];
        const Eigen::Vector3d& centre = present[part].centroid;
        if (factors[part] == 1) return;
        positions[vertex] = centre + factors[part] * (positions[vertex] - centre);
    });
    return inflated;
}

std::vector<Preserver::Swept> Preserver::sweep(const Positions& positions,
                                               const Positions& velocity) const {
    return sums_of_parts<Swept>(surface_, [&](const Triangle& t) {
        const auto initial = initial_corners(t), present = corners_of(positions, t);
        return Swept{swept_volume(initial, present),
                     swept_volume_rate(initial, present, corners_of(velocity, t))};
    });
}

std::optional<double> Preserver::push(const Positions& velocity, Positions& positions) const {
    const std::int32_t vertices = surface_.stars.count();
    Positions moved = positions;
    std::vector<double> pressures(initial_.size(), 0);
    std::vector<double> left(initial_.size(), 0);  // swept volume, relative
    for (int step = 0; step <= kStepsOfNewton; ++step) {
        const std::vector<Swept> swept = sweep(moved, velocity);
        std::vector<double> change(initial_.size(), 0);
        bool goes_on = false;
        for (std::size_t i = 0; i < initial_.size(); ++i) {
            const double area = initial_[i].area;
            if (std::abs(swept[i].rate) <= kHardlyMoves * area) continue;
            const double size = initial_[i].box.sizes().maxCoeff();
            left[i] = std::abs(swept[i].volume) / (area * size);
            change[i] = -swept[i].volume / swept[i].rate;
            goes_on = goes_on || left[i] > kGoalOfSwept;
        }
        if (!goes_on || step == kStepsOfNewton) break;
        for (std::size_t i = 0; i < initial_.size(); ++i) pressures[i] += change[i];
        parallel_for_rows(vertices, [&](std::int32_t vertex) {
            moved[vertex] += change[surface_.parts[vertex]] * velocity[vertex];
        });
    }
    const std::vector<Measures> restored = measure(moved);
    double initial_area = 0, inflated = 0, not_restored = 0;
    for (std::size_t i = 0; i < initial_.size(); ++i) {
        initial_area += initial_[i].area;
        const bool is_restored = left[i] <= kMostSwept;
        if (is_restored && initial_[i].bounds.contains(restored[i].box)) continue;
        (is_restored ? inflated : not_restored) += initial_[i].area;
        pressures[i] = 0;
    }
    if (not_restored > kMostInSpecks * initial_area) return std::nullopt;
    parallel_for_rows(vertices, [&](std::int32_t vertex) {
        const double pressure = pressures[surface_.parts[vertex]];
        if (pressure != 0) positions[vertex] = moved[vertex];
    });
    return inflated;
}

}  // namespace tracked_mcf
