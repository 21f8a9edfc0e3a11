// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow_state.h"
#include "filter_tracked_mcf/core/flow/stepper.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The size of a component's bounds, in longest sides of its initial box or in diameters of the
/// sphere that it may become. The flow makes no surface longer, but thin threads and flat ends that
/// have pinched do not shrink with the rest, and so preserving would make them grow without bound.
/// Long shapes become longer in a conformalized flow before they become round.
inline constexpr double kLargestGrowth = 4, kLargestConformalizedGrowth = 16;

/// Restores the area or the volume of each connected component after each step of a flow.
class Preserver {
public:
    /// Measures the domain's surface. The domain's mesh must outlive the preserver and keep its
    /// positions. `stepper` must have been made from this domain and outlive the preserver.
    Preserver(const Domain& domain, Preserve kind, const Stepper& stepper);

    /// Restores what is preserved in `to`, the state after the stepper's last step. Returns
    /// Stop::Vanished if the step has left almost nothing, Stop::Pinched if it has left only thin
    /// threads, and Stop::NotPreserved if it has changed the volume so much that no pressure
    /// restores it. A component that has vanished, cannot move, or would be inflated because only
    /// thin threads are left of it, stays as it is.
    StepResult restore(FlowState to) const;

private:
    /// Measures of a component, mesh units.
    struct Measures {
        double area = 0;
        double volume = 0;         ///< enclosed, if the surface is closed
        Eigen::Vector3d centroid;  ///< of the surface; undefined without area
        Eigen::AlignedBox3d box;
        Eigen::AlignedBox3d bounds;  ///< initial_: where the component must stay
    };

    std::vector<Measures> measure(const std::vector<Eigen::Vector3d>& positions) const;
    /// Returns the vertices' positions in a state.
    std::vector<Eigen::Vector3d> moved(const FlowState& state) const;
    /// Adds the initial area of components that a scaling would take out of their bounds to
    /// `blown_up`; they are not scaled. restore_volumes() does alike.
    std::vector<Scaling> scalings(const std::vector<Measures>& present, double& blown_up) const;
    /// Scales the embedding of each component.
    void scale(FlowState& state, std::vector<Scaling> scalings) const;
    /// Adds to the displacement, for each component, the multiple of the pressure response that
    /// takes the swept volume back to zero. `positions` are those after the step. Returns false,
    /// without a change, if there is no such multiple.
    bool restore_volumes(FlowState& state, const Coefficients& response,
                         std::vector<Eigen::Vector3d> positions, double& blown_up) const;

    const Stepper& stepper_;
    const TriangleMesh& mesh_;
    std::vector<Triangle> triangles_;         ///< those that flow
    std::vector<std::int32_t> component_of_;  ///< per triangle
    Preserve kind_;
    std::vector<Measures> initial_;
};

}  // namespace tracked_mcf
