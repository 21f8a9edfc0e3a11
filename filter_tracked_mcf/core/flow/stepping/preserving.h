// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/stepping/flow_surface.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"

namespace tracked_mcf {

/// The size of a component's bounds, in longest sides of its initial box or in diameters of the
/// sphere that it may become. The flow makes no surface longer, but thin threads and flat ends that
/// have pinched do not shrink with the rest, and so preserving would make them grow without bound.
/// Long shapes become longer in a conformalized flow before they become round.
inline constexpr double kLargestGrowth = 4, kLargestConformalizedGrowth = 16;

/// Restores the area or the volume of each connected component of a surface after each step.
class Preserver {
public:
    /// Measures the initial surface, which must outlive this.
    Preserver(const FlowSurface& surface, Preserve kind, FlowKind flow);

    /// Returns whether components are pushed along their normals, instead of scaled.
    bool pushes() const { return pushes_; }

    /// Computes the pull of a pressure of 1 on each vertex: ∫ φ n, with the normal n.
    void pressure(const std::vector<Eigen::Vector3d>& positions, Field& pull) const;

    /// Restores what is preserved in `positions`, those after a step. `response` is how the step's
    /// system answers a pressure of 1, if components are pushed.
    ///
    /// Returns Stop::Vanished if the step has left almost nothing, Stop::Pinched if it has left
    /// only thin threads, and Stop::NotPreserved if it has changed the volume so much that no
    /// pressure restores it. A component that has vanished, cannot move, or would be inflated
    /// because only thin threads are left of it, stays as it is.
    Stop restore(const std::vector<Eigen::Vector3d>& response,
                 std::vector<Eigen::Vector3d>& positions) const;

private:
    struct Measures {
        double area = 0;
        double volume = 0;  ///< enclosed, if the surface is closed
        Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
        Eigen::AlignedBox3d box;
        Eigen::AlignedBox3d bounds;  ///< initial_: where the component must stay
    };

    std::vector<Measures> measure(const std::vector<Eigen::Vector3d>& positions) const;
    /// Scales components, and returns the initial area of those that would leave their bounds.
    double scale(const std::vector<Measures>& present,
                 std::vector<Eigen::Vector3d>& positions) const;
    /// Adds to the positions, for each component, the multiple of the velocity that takes the swept
    /// volume back to zero. Returns the initial area of components that would leave their bounds;
    /// nothing if there is no such multiple.
    std::optional<double> push(const std::vector<Eigen::Vector3d>& velocity,
                               std::vector<Eigen::Vector3d>& positions) const;

    const FlowSurface& surface_;
    const std::vector<Eigen::Vector3d> before_;  ///< the initial positions
    const Preserve kind_;
    const bool pushes_;
    std::vector<Measures> initial_;
};

}  // namespace tracked_mcf
