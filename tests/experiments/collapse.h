#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// Which vertices have lost the surface around them, and where they were then. A vertex collapses
/// after the first step that leaves its triangles less than 1e-4 of their initial area.
class Collapse {
public:
    explicit Collapse(const TriangleMesh& mesh);

    /// To be called after every step.
    void look(const TriangleMesh& moved);

    /// How far collapsed vertices are from where they collapsed, mesh units.
    struct Drift {
        std::int64_t vertices = 0;  ///< that have collapsed
        double rms = 0;
        double worst = 0;
    };
    Drift drift(const TriangleMesh& moved) const;

private:
    std::vector<double> initial_areas_;                 ///< around every vertex
    std::vector<std::uint8_t> collapsed_;               ///< of every vertex
    std::vector<Eigen::Vector3d> collapsed_positions_;  ///< of those that have
};

}  // namespace tracked_mcf::experiments
