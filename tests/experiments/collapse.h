// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// Records the vertices that have lost the surface around them, and their positions at that time. A
/// vertex collapses in the first step that leaves its triangles less than 1e-4 of their initial
/// area.
class Collapse {
public:
    explicit Collapse(const TriangleMesh& mesh);

    /// Records newly collapsed vertices. Call it after every step.
    void record(const TriangleMesh& moved);

    /// The distance of collapsed vertices from their recorded positions, in mesh units.
    struct Drift {
        std::int64_t vertices = 0;  ///< number of collapsed vertices
        double rms = 0;
        double worst = 0;
    };
    Drift drift(const TriangleMesh& moved) const;

private:
    std::vector<double> initial_areas_;                 ///< around each vertex
    std::vector<std::uint8_t> collapsed_;               ///< for each vertex
    std::vector<Eigen::Vector3d> collapsed_positions_;  ///< of collapsed vertices
};

}  // namespace tracked_mcf::experiments
