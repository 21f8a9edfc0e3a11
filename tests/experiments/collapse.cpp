// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/experiments/collapse.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tracked_mcf::experiments {

namespace {

constexpr double kCollapsedAreaRatio = 1e-4;

/// Returns the area of the triangles around each vertex.
std::vector<double> areas_around_vertices(const TriangleMesh& mesh) {
    std::vector<double> areas(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]])
                                      .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                                      .norm();
        for (const std::int32_t vertex : t) areas[vertex] += area;
    }
    return areas;
}

}  // namespace

Collapse::Collapse(const TriangleMesh& mesh)
    : initial_areas_(areas_around_vertices(mesh)),
      collapsed_(mesh.positions.size()),
      collapsed_positions_(mesh.positions) {}

void Collapse::record(const TriangleMesh& moved) {
    const std::vector<double> areas = areas_around_vertices(moved);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (collapsed_[i] != 0 || areas[i] >= kCollapsedAreaRatio * initial_areas_[i]) continue;
        collapsed_[i] = 1;
        collapsed_positions_[i] = moved.positions[i];
    }
}

Collapse::Drift Collapse::drift(const TriangleMesh& moved) const {
    Drift drift;
    double squares = 0;
    for (std::size_t i = 0; i < collapsed_.size(); ++i) {
        if (collapsed_[i] == 0) continue;
        const double distance = (moved.positions[i] - collapsed_positions_[i]).norm();
        ++drift.vertices;
        squares += distance * distance;
        drift.worst = std::max(drift.worst, distance);
    }
    if (drift.vertices > 0) drift.rms = std::sqrt(squares / static_cast<double>(drift.vertices));
    return drift;
}

}  // namespace tracked_mcf::experiments
