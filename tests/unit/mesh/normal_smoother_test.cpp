// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/normal_smoother.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using Normals = NormalSmoother::Normals;

Normals smoothed(const TriangleMesh& mesh, double step_size, double normal_length,
                 std::vector<double> densities = {}) {
    return NormalSmoother(topology_of(mesh), std::move(densities))
        .smooth(mesh.positions, step_size, normal_length);
}

/// Returns the mean angle between the normals and the expected ones, in degrees.
template <class Expected>
double mean_angle(const TriangleMesh& mesh, const Normals& normals, const Expected& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double cosine = normals[i].head<3>().cast<double>().dot(expected(mesh.positions[i]));
        sum += std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    return sum / static_cast<double>(normals.size()) * 180 / std::acos(-1.0);
}

Eigen::Vector3d outwards(const Eigen::Vector3d& position) {
    return position.normalized();
}

/// The normal of the unit cube's nearest face.
Eigen::Vector3d of_face(const Eigen::Vector3d& position) {
    const Eigen::Vector3d centred = position - Eigen::Vector3d::Constant(0.5);
    int axis = 0;
    centred.cwiseAbs().maxCoeff(&axis);
    return std::copysign(1.0, centred[axis]) * Eigen::Vector3d::Unit(axis);
}

TEST(NormalSmoother, KeepsTheNormalsOfASphere) {
    const TriangleMesh sphere = shapes::geodesic_sphere(20);
    EXPECT_LT(mean_angle(sphere, smoothed(sphere, 0.01, 0), outwards), 0.2);
    EXPECT_LT(mean_angle(sphere, smoothed(sphere, 0.01, 0.5), outwards), 0.2);
}

/// Moves vertices along the normals of a sphere, each or one of a few.
TriangleMesh noisy_sphere(double deviation, int one_of = 1) {
    TriangleMesh sphere = shapes::geodesic_sphere(30);
    std::mt19937 random(3);
    std::normal_distribution<double> noise;
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        const double height = deviation * noise(random);
        if (i % static_cast<std::size_t>(one_of) == 0) sphere.positions[i] *= 1 + height;
    }
    return sphere;
}

double noise_of(const TriangleMesh& mesh, std::vector<double> densities = {}) {
    return NormalSmoother(topology_of(mesh), std::move(densities)).noise(mesh.positions);
}

TEST(NormalSmoother, FindsTheDeviationOfNoise) {
    for (const double deviation : {0.001, 0.003, 0.01}) {
        EXPECT_NEAR(noise_of(noisy_sphere(deviation)), deviation, 0.06 * deviation);
    }
    // A density of 4 belongs to lengths half as long, beside which noise is twice as large.
    const TriangleMesh sphere = noisy_sphere(0.003);
    const double dense = noise_of(sphere, std::vector<double>(sphere.triangles.size(), 4));
    EXPECT_NEAR(dense, 2 * noise_of(sphere), 1e-9);
    EXPECT_GT(noise_of(noisy_sphere(0.01, 5)), 0.001);
}

TEST(NormalSmoother, FindsLittleNoiseOnACleanSurface) {
    EXPECT_LT(noise_of(noisy_sphere(0)), 2e-5);
    EXPECT_LT(noise_of(shapes::box(20, {1, 1, 1})), 1e-6);
    EXPECT_LT(noise_of(shapes::tube(100, 40, 2)), 1e-4);
    EXPECT_EQ(noise_of(TriangleMesh()), 0);
}

TEST(NormalSmoother, RemovesNoise) {
    const TriangleMesh sphere = noisy(shapes::geodesic_sphere(20), 0.01);
    const double before = mean_angle(sphere, smoothed(sphere, 0, 0), outwards);
    EXPECT_GT(before, 3);
    EXPECT_LT(mean_angle(sphere, smoothed(sphere, 0.02, 0.3), outwards), 0.5 * before);
}

TEST(NormalSmoother, KeepsEdgesThatItWouldBlurOtherwise) {
    const TriangleMesh cube = noisy(shapes::box(20, {1, 1, 1}), 0.003);
    const double blurred = mean_angle(cube, smoothed(cube, 0.01, 0), of_face);
    const double kept = mean_angle(cube, smoothed(cube, 0.01, 0.4), of_face);
    EXPECT_LT(kept, 0.6 * blurred);
}

TEST(NormalSmoother, OrientationDoesNotMatter) {
    const TriangleMesh mesh = noisy(shapes::box(10, {1, 1, 1}), 0.01);
    TriangleMesh turned = mesh;
    std::mt19937 random(3);
    // The first triangle orients the others.
    for (std::size_t i = 1; i < turned.triangles.size(); ++i) {
        if (random() % 2 == 0) std::swap(turned.triangles[i][1], turned.triangles[i][2]);
    }
    const Normals expected = smoothed(mesh, 0.01, 0.4), normals = smoothed(turned, 0.01, 0.4);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        EXPECT_LT((normals[i] - expected[i]).norm(), 1e-4);
    }
}

TEST(NormalSmoother, GivesUnitVectorsOnBadMeshes) {
    TriangleMesh copies = shapes::stack(shapes::square(4), 3, 0);
    TriangleMesh flat = shapes::fan(50);
    flat.positions[3] = flat.positions[4];
    for (const TriangleMesh& mesh :
         {shapes::moebius_band(40, 5), copies, flat, shapes::separate_triangles(20)}) {
        const NormalSmoother smoother(topology_of(mesh), {});
        for (const Eigen::Vector4f& normal : smoothed(mesh, 0.1, 1)) {
            ASSERT_TRUE(normal.allFinite());
            EXPECT_TRUE(normal.isZero() || std::abs(normal.norm() - 1) < 1e-4);
        }
    }
}

TEST(NormalSmoother, ASoupHasTheNormalsOfItsMesh) {
    const TriangleMesh mesh = noisy(shapes::box(6, {1, 1, 1}), 0.01);
    const TriangleMesh soup = shapes::soup(mesh);
    const MeshTopology topology = topology_of(soup);
    const Normals expected = smoothed(mesh, 0.01, 0.3), normals = smoothed(soup, 0.01, 0.3);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT((normals[topology.triangles[i][k]] - expected[mesh.triangles[i][k]]).norm(),
                      1e-5);
        }
    }
}

TEST(NormalSmoother, ALargerStepWhereDensitiesAreSmall) {
    const TriangleMesh mesh = noisy(shapes::geodesic_sphere(12), 0.02);
    const std::vector<double> quarter(mesh.triangles.size(), 0.25);
    const Normals expected = smoothed(mesh, 0.04, 0.4),
                  normals = smoothed(mesh, 0.01, 0.2, quarter);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        EXPECT_LT((normals[i] - expected[i]).norm(), 2e-3);
    }
}

}  // namespace
}  // namespace tracked_mcf
