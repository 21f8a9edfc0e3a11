// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {

inline std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
    std::vector<Eigen::Vector3d> normals(mesh.positions.size(), Eigen::Vector3d::Zero());
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) normals[vertex] += twice_vector_area(mesh, t);
    }
    for (Eigen::Vector3d& normal : normals) normal.stableNormalize();
    return normals;
}

/// Moves the vertices along their normals by normal noise of this deviation, in mean edges.
inline TriangleMesh with_noise(TriangleMesh mesh, double deviation) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, deviation * mean_edge_length(mesh));
    const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        mesh.positions[i] += normal(random) * normals[i];
    }
    return mesh;
}

/// Moves the vertices by normal noise of this deviation in each coordinate, in mean edges.
inline TriangleMesh with_isotropic_noise(TriangleMesh mesh, double deviation) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, deviation * mean_edge_length(mesh));
    for (Eigen::Vector3d& position : mesh.positions) {
        for (double& coordinate : position) coordinate += normal(random);
    }
    return mesh;
}

inline NoisySurface surface_of_mesh(const TriangleMesh& mesh) {
    return surface_of(Domain(mesh, BoundaryCondition::Free)).surface;
}

/// Returns a cube with 20 edges along each of its own.
inline TriangleMesh cube() {
    return shapes::box(20, {1, 1, 1});
}

inline TriangleMesh denoised(TriangleMesh mesh, const NoiseParameters& parameters = {}) {
    remove_noise(mesh, {}, parameters);
    return mesh;
}

inline NoiseReport report_of(TriangleMesh mesh, const NoiseParameters& parameters = {}) {
    return remove_noise(mesh, {}, parameters);
}

}  // namespace tracked_mcf
