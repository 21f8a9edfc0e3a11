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

    /// Smooths the normals of the surface with this displacement, in grid units, and sets the
    /// tensors. Triangles at constrained edges have none: a rim is no edge.
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
    std::vector<std::uint8_t> at_constrained_edge_;  ///< per triangle
    std::vector<EdgeTensor> tensors_;
};

}  // namespace tracked_mcf
