// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/noisy_surface.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/measures.h"
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
    std::normal_distribution<double> normal;
    const double height = deviation * mean_edge_length(mesh);
    const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        mesh.positions[i] += height * normal(random) * normals[i];
    }
    return mesh;
}

/// Moves the vertices along their normals by noise of this deviation, in mean edges, that is
/// averaged over the neighbours so many times.
inline TriangleMesh with_shared_noise(TriangleMesh mesh, double deviation, int averagings) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> heights(mesh.positions.size());
    for (double& height : heights) height = normal(random);
    for (int i = 0; i < averagings; ++i) {
        std::vector<double> sums(heights.size(), 0), counts(heights.size(), 0);
        for (const Triangle& t : mesh.triangles) {
            for (const std::int32_t vertex : t) {
                for (const std::int32_t corner : t) sums[vertex] += heights[corner];
                counts[vertex] += 3;
            }
        }
        for (std::size_t v = 0; v < heights.size(); ++v) heights[v] = sums[v] / counts[v];
    }
    double squares = 0;
    for (const double height : heights) squares += height * height;
    const double scale = deviation * mean_edge_length(mesh) /
                         std::sqrt(squares / static_cast<double>(heights.size()));
    const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
    for (std::size_t v = 0; v < heights.size(); ++v)
        mesh.positions[v] += scale * heights[v] * normals[v];
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

/// Returns the surface of a welded mesh, whose vertices keep their numbers.
inline NoisySurface surface_of_mesh(const TriangleMesh& mesh) {
    const Surface surface = surface_of(mesh);
    NoisySurface noisy{Stars({mesh.triangles.begin(), mesh.triangles.end()},
                             static_cast<std::int32_t>(mesh.positions.size())),
                       mesh.positions, std::vector<float>(mesh.positions.size(), 1)};
    for (Eigen::Vector3d& position : noisy.positions)
        position = (position - surface.box.center()) / surface.edge;
    return noisy;
}

/// Returns a cube with 20 edges along each of its own.
inline TriangleMesh cube() {
    return shapes::box(20, {1, 1, 1});
}

/// Returns a relief over n x n cells of side 1, whose heights over x and y are rounded to whole
/// numbers.
template <typename Height>
TriangleMesh raster(int n, const Height& height) {
    TriangleMesh mesh = shapes::square(n);
    for (Eigen::Vector3d& p : mesh.positions)
        p = {n * p.x(), n * p.y(), std::round(height(n * p.x(), n * p.y()))};
    return mesh;
}

/// Returns the RMS distance of the vertices to the clean surface, along its normals.
inline double error_along_normals(const TriangleMesh& mesh, const TriangleMesh& clean) {
    const std::vector<Eigen::Vector3d> normals = vertex_normals(clean);
    double squares = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double height = normals[i].dot(mesh.positions[i] - clean.positions[i]);
        squares += height * height;
    }
    return std::sqrt(squares / static_cast<double>(normals.size()));
}

inline TriangleMesh denoised(TriangleMesh mesh, const NoiseParameters& parameters = {}) {
    remove_noise(mesh, {}, parameters);
    return mesh;
}

inline NoiseReport report_of(TriangleMesh mesh, const NoiseParameters& parameters = {}) {
    return remove_noise(mesh, {}, parameters);
}

/// Expects that at least half of the noise is gone.
inline void expect_halved(const TriangleMesh& after, const TriangleMesh& before,
                          const TriangleMesh& clean) {
    EXPECT_LT(error_along_normals(after, clean), 0.5 * error_along_normals(before, clean));
}

}  // namespace tracked_mcf
