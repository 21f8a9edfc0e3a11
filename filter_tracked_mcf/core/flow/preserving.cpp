// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/preserving.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The flow ends if components of more than this share of the area would be inflated.
constexpr double kMostBlownUp = 0.5;

/// The volume that a component has swept, relative to its area times its size. Newton's method
/// takes it to the goal in a few steps, or to the rounding errors of a mesh far from the origin,
/// unless the flow's step has changed the shape beyond recovery.
constexpr double kSweptGoal = 1e-13, kSweptAtMost = 1e-7;
constexpr int kMostNewtonSteps = 10;

/// A component cannot move if a pressure moves it less than this fraction of what it moves a plane.
constexpr double kImmovable = 1e-9;

}  // namespace

Preserver::Preserver(const Domain& domain, Preserve kind, const Stepper& stepper)
    : stepper_(stepper), mesh_(domain.mesh()), triangles_(domain.surface().triangles), kind_(kind) {
    component_of_.reserve(triangles_.size());
    for (const Triangle& triangle : triangles_) {
        const TrackedElements& elements = stepper.elements();
        component_of_.push_back(
            elements.components.of_element[elements.vertices[triangle[0]].element]);
    }
    initial_ = measure(mesh_.positions);
    const double growth = stepper.plan().flow == FlowKind::Conformalized
                              ? kLargestConformalizedGrowth
                              : kLargestGrowth;
    for (Measures& component : initial_) {
        const double sphere = std::sqrt(component.area / std::acos(-1.0));
        const double half = growth / 2 * std::max(component.box.sizes().maxCoeff(), sphere);
        component.bounds = {component.box.center().array() - half,
                            component.box.center().array() + half};
    }
}

std::vector<Preserver::Measures> Preserver::measure(
    const std::vector<Eigen::Vector3d>& positions) const {
    std::vector<Measures> components(
        initial_.empty() ? 1 + *std::max_element(component_of_.begin(), component_of_.end())
                         : initial_.size());
    // Relative to a vertex, so that a surface far from the origin loses no digits.
    const Eigen::Vector3d& near = mesh_.positions[triangles_.front()[0]];
    for (Measures& component : components) component.centroid.setZero();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Measures& component = components[component_of_[i]];
        const auto corners = corners_of(positions, triangles_[i]);
        const Eigen::Vector3d normal = twice_vector_area(corners[0], corners[1], corners[2]) / 2;
        component.area += normal.norm();
        component.volume += (corners[0] - near).dot(normal) / 3;
        for (const Eigen::Vector3d& corner : corners) {
            component.centroid += normal.norm() / 3 * (corner - near);
            component.box.extend(corner);
        }
    }
    for (Measures& component : components) {
        component.centroid = near + component.centroid / component.area;
    }
    return components;
}

std::vector<Eigen::Vector3d> Preserver::moved(const FlowState& state) const {
    std::vector<Eigen::Vector3d> positions = mesh_.positions;
    add_at_vertices(stepper_.elements(), state.displacement, positions);
    return positions;
}

StepResult Preserver::restore(FlowState to) const {
    std::vector<Eigen::Vector3d> positions = moved(to);
    const std::vector<Measures> present = measure(positions);
    double area = 0, initial_area = 0;
    for (std::size_t i = 0; i < present.size(); ++i) {
        area += present[i].area;
        initial_area += initial_[i].area;
    }
    if (!(area > kVanishedArea * initial_area)) return Stop::Vanished;
    double blown_up = 0;  // initial area
    if (!stepper_.plan().takes_responses) {
        scale(to, scalings(present, blown_up));
    } else if (!restore_volumes(to, stepper_.pressure_response(), std::move(positions), blown_up)) {
        return Stop::NotPreserved;
    }
    if (blown_up > kMostBlownUp * initial_area) return Stop::Pinched;
    to.boxes = stepper_.confinement().boxes(to.displacement);
    return to;
}

void Preserver::scale(FlowState& state, std::vector<Scaling> scalings) const {
    const TrackedElements& elements = stepper_.elements();
    const Coefficients identity = identity_coefficients(elements);
    parallel_for_rows(elements.finest().unknown_count(), [&](std::int32_t unknown) {
        const auto& [centre, factor] = scalings[elements.components.of_unknown[unknown]];
        const Eigen::RowVector3d from_centre =
            identity.row(unknown) - elements.grid.to_grid(centre).transpose();
        auto displacement = state.displacement.row(unknown);
        displacement = factor * displacement + (factor - 1) * from_centre;
    });
    state.scalings = std::move(scalings);
}

std::vector<Scaling> Preserver::scalings(const std::vector<Measures>& present,
                                         double& blown_up) const {
    std::vector<Scaling> scalings(present.size());
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
            scalings[i] = {centre, factor};
        } else {
            blown_up += initial_[i].area;
        }
    }
    return scalings;
}

bool Preserver::restore_volumes(FlowState& state, const Coefficients& response,
                                std::vector<Eigen::Vector3d> positions, double& blown_up) const {
    const TrackedElements& elements = stepper_.elements();
    // Of the vertices, under a pressure of 1.
    std::vector<Eigen::Vector3d> velocity(positions.size(), Eigen::Vector3d::Zero());
    add_at_vertices(elements, response, velocity);
    std::vector<double> pressures(initial_.size(), 0);
    double worst = 0;  // swept volume, relative
    for (int step = 0; step <= kMostNewtonSteps; ++step) {
        std::vector<double> swept(initial_.size(), 0), rate(initial_.size(), 0);
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const Triangle& t = triangles_[i];
            const auto initial = corners_of(mesh_.positions, t);
            const auto present = corners_of(positions, t);
            swept[component_of_[i]] += swept_volume(initial, present);
            rate[component_of_[i]] += swept_volume_rate(initial, present, corners_of(velocity, t));
        }
        worst = 0;
        std::vector<double> change(initial_.size(), 0);
        for (std::size_t i = 0; i < initial_.size(); ++i) {
            const double area = initial_[i].area;
            if (std::abs(rate[i]) <= kImmovable * elements.grid.cell_size * area) continue;
            const double size = initial_[i].box.sizes().maxCoeff();
            worst = std::max(worst, std::abs(swept[i]) / (area * size));
            change[i] = -swept[i] / rate[i];
        }
        if (worst <= kSweptGoal || step == kMostNewtonSteps) break;
        for (std::size_t i = 0; i < initial_.size(); ++i) pressures[i] += change[i];
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const std::int32_t element = elements.vertices[i].element;
            if (element == VertexLocation::kNoElement) continue;
            positions[i] += change[elements.components.of_element[element]] * velocity[i];
        }
    }
    if (!(worst <= kSweptAtMost)) return false;
    const std::vector<Measures> restored = measure(positions);
    for (std::size_t i = 0; i < initial_.size(); ++i) {
        if (initial_[i].bounds.contains(restored[i].box)) continue;
        blown_up += initial_[i].area;
        pressures[i] = 0;
    }
    parallel_for_rows(elements.finest().unknown_count(), [&](std::int32_t unknown) {
        state.displacement.row(unknown) +=
            pressures[elements.components.of_unknown[unknown]] * response.row(unknown);
    });
    return true;
}

}  // namespace tracked_mcf
