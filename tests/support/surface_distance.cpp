// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tracked_mcf {

namespace {

using Eigen::Vector3d;

/// Per vertex: a third of the vector areas, and of the areas, of the triangles around it.
struct VertexAreas {
    std::vector<Vector3d> vectors;
    std::vector<double> areas;
};

VertexAreas vertex_areas(const TriangleMesh& mesh) {
    VertexAreas sums = {std::vector<Vector3d>(mesh.positions.size(), Vector3d::Zero()),
                        std::vector<double>(mesh.positions.size())};
    for (const Triangle& t : mesh.triangles) {
        const Vector3d third = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                   .cross(mesh.positions[t[2]] - mesh.positions[t[0]]) /
                               6;
        for (const std::int32_t vertex : t) {
            sums.vectors[vertex] += third;
            sums.areas[vertex] += third.norm();
        }
    }
    return sums;
}

/// Flags the vertices of flagged triangles.
std::vector<std::uint8_t> corners_of(const TriangleMesh& mesh,
                                     const std::vector<std::uint8_t>& triangles) {
    std::vector<std::uint8_t> marked(mesh.positions.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i] == 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) marked[vertex] = 1;
    }
    return marked;
}

}  // namespace

NormalDistance normal_distance(const TriangleMesh& mesh, const TriangleMesh& reference,
                               const std::vector<std::uint8_t>& left_out) {
    const VertexAreas sums = vertex_areas(reference);
    NormalDistance distance;
    double squares = 0;
    double covered = 0;
    double whole = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const double area = sums.areas[i];
        whole += area;
        if (area == 0 || (!left_out.empty() && left_out[i] != 0)) continue;
        const double along = std::abs(
            (mesh.positions[i] - reference.positions[i]).dot(sums.vectors[i].stableNormalized()));
        squares += area * along * along;
        covered += area;
        distance.worst = std::max(distance.worst, along);
    }
    if (covered == 0) return distance;
    distance.rms = std::sqrt(squares / covered);
    distance.covered = covered / whole;
    return distance;
}

std::vector<std::uint8_t> vertices_around(const TriangleMesh& mesh,
                                          const std::vector<std::uint8_t>& triangles) {
    const std::vector<std::uint8_t> corners = corners_of(mesh, triangles);
    std::vector<std::uint8_t> touched(triangles.size());
    for (std::size_t i = 0; i < touched.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        touched[i] = corners[t[0]] | corners[t[1]] | corners[t[2]];
    }
    return corners_of(mesh, touched);
}

double worst_distance(const TriangleMesh& a, const TriangleMesh& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        worst = std::max(worst, (a.positions[i] - b.positions[i]).norm());
    }
    return worst;
}

double rms_distance(const TriangleMesh& a, const TriangleMesh& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        squares += (a.positions[i] - b.positions[i]).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(a.positions.size()));
}

double diagonal(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) box.extend(mesh.positions[vertex]);
    }
    return box.diagonal().norm();
}

}  // namespace tracked_mcf
