// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// The size of a part's bounds, in longest sides of its initial box or in diameters of the
/// sphere that it may become. The flow makes no surface longer, but thin threads and flat ends that
/// have pinched do not shrink with the rest, and so preserving would make them grow without bound.
/// Long shapes become longer in a conformalized flow before they become round.
inline constexpr double kLargestGrowth = 4, kLargestConformalizedGrowth = 16;

/// Restores the area or the volume of each part of a surface after each step.
class Preserver {
public:
    /// Measures the initial surface of a mesh, whose vertices are at `initial`. Surface and mesh
    /// must outlive this.
    Preserver(const Surface& surface, const TriangleMesh& mesh, const Positions& initial,
              Preserve kind, FlowKind flow);

    /// Returns whether parts are pushed along their normals, instead of scaled.
    bool pushes() const { return pushes_; }

    /// Computes the pull of a pressure of 1 on each vertex: ∫ φ n, with the normal n.
    void pressure(const Positions& positions, Field& pull) const;

    /// Restores what is preserved in `positions`, those after a step. `response` is how the step's
    /// system answers a pressure of 1, if parts are pushed.
    ///
    /// Returns Stop::Vanished if the step has left almost nothing, Stop::Pinched if it has left
    /// only thin threads, and Stop::NotPreserved if it has changed the volume so much that no
    /// pressure restores it. A part that has vanished, cannot move, or would be inflated
    /// because only thin threads are left of it, stays as it is. So do specks whose volume no
    /// pressure restores.
    Stop restore(const Positions& response, Positions& positions) const;

private:
    struct Measures {
        double area = 0;
        double volume = 0;  ///< enclosed, if the surface is closed
        Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
        Eigen::AlignedBox3d box;
        Eigen::AlignedBox3d bounds;  ///< initial_: where the part must stay

        Measures& operator+=(const Measures& other);
    };
    /// The volume that a part has swept, and its derivative by the pressure.
    struct Swept {
        double volume = 0, rate = 0;

        Swept& operator+=(const Swept& other);
    };

    std::vector<Measures> measure(const Positions& positions) const;
    std::vector<Swept> sweep(const Positions& positions, const Positions& velocity) const;
    /// Scales parts, and returns the initial area of those that would leave their bounds.
    double scale(const std::vector<Measures>& present, Positions& positions) const;
    /// Adds to the positions, for each part, the multiple of the velocity that takes the swept
    /// volume back to zero. Returns the initial area of parts that would leave their bounds;
    /// nothing if there is no such multiple for parts that are more than specks.
    std::optional<double> push(const Positions& velocity, Positions& positions) const;

    /// Returns the corners of a triangle as they were at the start.
    std::array<Eigen::Vector3d, 3> initial_corners(const Triangle& t) const {
        return {surface_.in_edges(mesh_, t[0]), surface_.in_edges(mesh_, t[1]),
                surface_.in_edges(mesh_, t[2])};
    }

    const Surface& surface_;
    const TriangleMesh& mesh_;
    const Preserve kind_;
    const bool pushes_;
    std::vector<Measures> initial_;
};

}  // namespace tracked_mcf
