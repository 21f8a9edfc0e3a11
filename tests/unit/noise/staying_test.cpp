// SPDX-License-Identifier: GPL-3.0-or-later
// What must stay where it is while noise is removed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// Returns which vertices are on the rim.
std::vector<std::uint8_t> rim_of(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    std::vector<std::uint8_t> rim(mesh.positions.size(), 0);
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(topology.boundary[t], side)) continue;
            rim[mesh.triangles[t][side]] = rim[mesh.triangles[t][(side + 1) % 3]] = 1;
        }
    }
    return rim;
}

/// Distances that vertices have moved, in mean edges of the clean mesh.
struct Sideways {
    double inside = 0, rim = 0;  ///< the largest
};

/// Returns how far vertices have moved at right angles to the normals of the clean mesh.
Sideways sideways(const TriangleMesh& clean, const TriangleMesh& before,
                  const TriangleMesh& after) {
    const std::vector<Eigen::Vector3d> normals = vertex_normals(clean);
    const std::vector<std::uint8_t> rim = rim_of(clean);
    const double edge = mean_edge_length(clean);
    Sideways largest;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Eigen::Vector3d moved = after.positions[i] - before.positions[i];
        const double aside = (moved - moved.dot(normals[i]) * normals[i]).norm() / edge;
        double& most = rim[i] != 0 ? largest.rim : largest.inside;
        most = std::max(most, aside);
    }
    return largest;
}

/// Returns the RMS height over a sheet in the plane z = 0, in mean edges, of its rim or inside.
double height(const TriangleMesh& sheet, const TriangleMesh& clean, bool of_rim) {
    const std::vector<std::uint8_t> rim = rim_of(clean);
    double squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if ((rim[i] != 0) != of_rim) continue;
        squares += sheet.positions[i][2] * sheet.positions[i][2];
        ++count;
    }
    return std::sqrt(squares / count) / mean_edge_length(clean);
}

/// A sheet whose vertices are spread unevenly in its plane.
TriangleMesh uneven_sheet() {
    constexpr int side = 40;
    TriangleMesh sheet = shapes::square(side);
    const std::vector<std::uint8_t> rim = rim_of(sheet);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.25 / side, 0.25 / side);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (rim[i] == 0) sheet.positions[i] += Eigen::Vector3d(shift(random), shift(random), 0);
    }
    return sheet;
}

TriangleMesh hills(double quantum) {
    TriangleMesh terrain = shapes::square(60);
    for (Eigen::Vector3d& p : terrain.positions) {
        p[2] = 0.05 * std::sin(9 * p[0]) * std::cos(7 * p[1]) + 0.05 * p[0];
        if (quantum > 0) p[2] = quantum * std::round(p[2] / quantum);
    }
    return terrain;
}

TEST(RemoveNoise, KeepsTheOutlineOfAnOpenSheet) {
    for (const TriangleMesh& clean :
         {shapes::square(60), uneven_sheet(), shapes::annulus(80, 15, 0.5, 1)}) {
        for (const double deviation : {0.02, 0.05, 0.2}) {
            const TriangleMesh before = with_noise(clean, deviation);
            const TriangleMesh after = denoised(before);
            EXPECT_NEAR(surface_area(after) / surface_area(clean), 1, 1e-3);
            EXPECT_LT(sideways(clean, before, after).rim, 0.05);
        }
    }
}

TEST(RemoveNoise, SmoothsARimAlongItsNormals) {
    for (const TriangleMesh& clean : {shapes::square(60), uneven_sheet()}) {
        const TriangleMesh after = denoised(with_noise(clean, 0.2));
        EXPECT_LT(height(after, clean, true), 0.4 * 0.2);
        EXPECT_LT(height(after, clean, false), 0.2 * 0.2);
    }
}

TEST(RemoveNoise, LetsVerticesSlideByTwiceTheNoise) {
    for (const TriangleMesh& clean : {uneven_sheet(), hills(0), shapes::box(20, {1, 1, 1})}) {
        for (const double deviation : {0.02, 0.1}) {
            const TriangleMesh before = with_noise(clean, deviation);
            EXPECT_LT(sideways(clean, before, denoised(before)).inside, 2.5 * deviation);
        }
    }
}

TEST(RemoveNoise, LeavesTerrainInWholeMetresAboveItsCells) {
    const TriangleMesh clean = hills(0);
    const double metre = 0.1 * mean_edge_length(clean);
    const TriangleMesh terraces = hills(metre), after = denoised(terraces);
    const double deviation = 0.1 / std::sqrt(12.0);  // of rounding, in edges
    const Sideways slid = sideways(clean, terraces, after);
    EXPECT_LT(slid.inside, 2.5 * deviation);
    EXPECT_LT(slid.rim, 0.5 * deviation);
    double squares = 0;
    for (std::size_t i = 0; i < clean.positions.size(); ++i) {
        const double error = after.positions[i][2] - clean.positions[i][2];
        squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(clean.positions.size())),
              0.4 * deviation * mean_edge_length(clean));
}

TEST(RemoveNoise, MovesVerticesAlongTheNormalsAloneIfAskedTo) {
    NoiseParameters parameters;
    parameters.along_normals = true;
    for (const TriangleMesh& clean : {uneven_sheet(), shapes::geodesic_sphere(20)}) {
        const TriangleMesh before = with_noise(clean, 0.1);
        const TriangleMesh after = denoised(before, parameters);
        // The smoothed normals are not exactly those of the clean mesh.
        EXPECT_LT(sideways(clean, before, after).inside, 0.02);
        EXPECT_LT(rms_distance(after, clean), 0.5 * rms_distance(before, clean));
    }
}

TEST(RemoveNoise, UnfoldsTrianglesThatNoiseHasFolded) {
    const TriangleMesh clean = shapes::geodesic_sphere(30);
    const auto folded = [&](const TriangleMesh& mesh) {
        return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            return twice_vector_area(mesh, t).dot(twice_vector_area(clean, t)) < 0;
        });
    };
    const TriangleMesh before = with_isotropic_noise(clean, 0.25);
    ASSERT_GT(folded(before), 100);
    EXPECT_EQ(folded(denoised(before)), 0);
}

}  // namespace
}  // namespace tracked_mcf
