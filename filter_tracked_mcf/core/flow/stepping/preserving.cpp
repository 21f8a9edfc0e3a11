// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/preserving.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

using Positions = std::vector<Eigen::Vector3d>;

/// The flow ends if components of more than this share of the area would be inflated.
constexpr double kMostInflated = 0.5;

/// The volume that a component has swept, relative to its area times its size. Newton's method
/// takes it to the goal in a few steps, unless the flow's step has changed the shape beyond
/// recovery.
constexpr double kGoalOfSwept = 1e-13, kMostSwept = 1e-7;
constexpr int kStepsOfNewton = 10;

/// A component cannot move if a pressure moves it less than this fraction of what it moves a plane.
constexpr double kHardlyMoves = 1e-9;

}  // namespace

Preserver::Preserver(const FlowSurface& surface, Preserve kind, FlowKind flow)
    : surface_(surface),
      before_(surface.positions),
      kind_(kind),
      pushes_(kind == Preserve::Volume && flow == FlowKind::MeanCurvature),
      initial_(measure(before_)) {
    const double growth =
        flow == FlowKind::Conformalized ? kLargestConformalizedGrowth : kLargestGrowth;
    for (Measures& component : initial_) {
        const double sphere = std::sqrt(component.area / kPi);
        const double half = growth / 2 * std::max(component.box.sizes().maxCoeff(), sphere);
        component.bounds = {component.box.center().array() - half,
                            component.box.center().array() + half};
    }
}

std::vector<Preserver::Measures> Preserver::measure(const Positions& positions) const {
    std::vector<Measures> components(static_cast<std::size_t>(surface_.component_count));
    for (const Triangle& t : surface_.stars.triangles) {
        Measures& component = components[surface_.components[t[0]]];
        const auto [a, b, c] = corners_of(positions, t);
        const Eigen::Vector3d normal = twice_vector_area(a, b, c) / 2;
        const double area = normal.norm();
        component.area += area;
        component.volume += a.dot(normal) / 3;
        component.centroid += area / 3 * (a + b + c);
        for (const Eigen::Vector3d& corner : {a, b, c}) component.box.extend(corner);
    }
    for (Measures& component : components) component.centroid /= component.area;
    return components;
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
        if (surface_.fixed[vertex] != 0) sum.setZero();
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
        // The ratio is negative if a component has turned inside out.
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
        const std::int32_t component = surface_.components[vertex];
        const Eigen::Vector3d& centre = present[component].centroid;
        if (factors[component] == 1) return;
        positions[vertex] = centre + factors[component] * (positions[vertex] - centre);
    });
    return inflated;
}

std::optional<double> Preserver::push(const Positions& velocity, Positions& positions) const {
    const Stars& stars = surface_.stars;
    Positions moved = positions;
    std::vector<double> pressures(initial_.size(), 0);
    double worst = 0;  // swept volume, relative
    for (int step = 0; step <= kStepsOfNewton; ++step) {
        std::vector<double> swept(initial_.size(), 0), rate(initial_.size(), 0);
        for (const Triangle& t : stars.triangles) {
            const std::int32_t component = surface_.components[t[0]];
            const auto initial = corners_of(before_, t), present = corners_of(moved, t);
            swept[component] += swept_volume(initial, present);
            rate[component] += swept_volume_rate(initial, present, corners_of(velocity, t));
        }
        worst = 0;
        std::vector<double> change(initial_.size(), 0);
        for (std::size_t i = 0; i < initial_.size(); ++i) {
            const double area = initial_[i].area;
            if (std::abs(rate[i]) <= kHardlyMoves * area) continue;
            const double size = initial_[i].box.sizes().maxCoeff();
            worst = std::max(worst, std::abs(swept[i]) / (area * size));
            change[i] = -swept[i] / rate[i];
        }
        if (worst <= kGoalOfSwept || step == kStepsOfNewton) break;
        for (std::size_t i = 0; i < initial_.size(); ++i) pressures[i] += change[i];
        parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
            moved[vertex] += change[surface_.components[vertex]] * velocity[vertex];
        });
    }
    if (!(worst <= kMostSwept)) return std::nullopt;
    const std::vector<Measures> restored = measure(moved);
    double inflated = 0;
    for (std::size_t i = 0; i < initial_.size(); ++i) {
        if (initial_[i].bounds.contains(restored[i].box)) continue;
        inflated += initial_[i].area;
        pressures[i] = 0;
    }
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const double pressure = pressures[surface_.components[vertex]];
        if (pressure != 0) positions[vertex] = moved[vertex];
    });
    return inflated;
}

}  // namespace tracked_mcf
