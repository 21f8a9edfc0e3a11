// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/normal_smoother.h"

namespace tracked_mcf {

/// A detail size ℓ as FlowParameters::keep_edges uses it: where the smooth normal turns by the
/// angle θ within ℓ, lengths across count √2 times.
struct EdgeSize {
    double detail_size;  ///< ℓ, grid units
    double angle;        ///< θ, degrees, greater than 0

    /// Returns s, at which the end of s N moves by ℓ where N turns by θ.
    double normal_length() const;
};

/// The metric of (X, s N), which keeps edges: that of X plus s² ∇N · ∇N, where N are the smooth
/// normals of the surface's vertices. Where the normal turns quickly the surface counts as long, so
/// that the flow crosses no edge. Dynamic and implicit, it is akin to the metric that Chuang,
/// Rusinkiewicz and Kazhdan make of the curvature ("Gradient-Domain Processing of Meshes", 2016).
class EdgeMetric {
public:
    /// The mesh of the domain must outlive the metric and keep its positions.
    EdgeMetric(const Domain& domain, const TrackedElements& elements, const EdgeSize& size,
               bool local_detail_size);

    /// Returns the standard deviation of the noise of the initial surface
    /// (NormalSmoother::noise), grid units.
    double noise() const { return noise_; }

    /// Returns the factor of a step's δ that makes up for noise: what is left of it in N makes
    /// smooth parts count as long, too.
    double step_factor() const { return step_factor_; }

    /// Makes the step factor smaller if the first step has moved most vertices by more than the
    /// noise explains: it has removed detail (the discrepancy principle, Morozov 1966). `movement`
    /// is the robust_deviation() of the vertices' movements, grid units. Returns whether it did.
    bool shorten_steps(double movement);

    /// Smooths the normals of the surface with this displacement, in grid units, and sets the
    /// tensors.
    void update(const TrackedElements& elements, const Coefficients& displacement);

    const EdgeSize& size() const { return size_; }

    /// Returns one tensor for each triangle of the domain's surface.
    const std::vector<EdgeTensor>& tensors() const { return tensors_; }

    /// Returns the share of the initial area where the smooth normals turn by more than the angle
    /// within the detail size.
    double edge_share() const;

private:
    EdgeTensor tensor_of(std::int64_t triangle, const NormalSmoother::Normals& normals) const;

    const std::vector<Eigen::Vector3d>& positions_;  ///< initial ones, mesh units
    Grid grid_;
    EdgeSize size_;
    NormalSmoother smoother_;
    double noise_;        ///< grid units
    double step_factor_;  ///< at least 1
    std::vector<EdgeTensor> tensors_;
};

}  // namespace tracked_mcf
