// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

using Eigen::Vector3d;

TEST(NormalDistance, OfSpheresIsTheDifferenceOfTheirRadii) {
    const TriangleMesh sphere = shapes::geodesic_sphere(24);
    const TriangleMesh larger = shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(1.25)));
    const NormalDistance distance = normal_distance(larger, sphere);
    EXPECT_NEAR(distance.rms, 0.25, 1e-4);
    EXPECT_NEAR(distance.worst, 0.25, 1e-4);
    EXPECT_DOUBLE_EQ(distance.covered, 1);
}

TEST(NormalDistance, OfATranslationIsItsNormalComponent) {
    // ∫ (n · e)² over the unit sphere is a third of its area.
    const TriangleMesh sphere = shapes::geodesic_sphere(24);
    const TriangleMesh moved =
        shapes::transformed(sphere, Eigen::Affine3d(Eigen::Translation3d(0, 0, 0.3)));
    const NormalDistance distance = normal_distance(moved, sphere);
    EXPECT_NEAR(distance.rms, 0.3 / std::sqrt(3.0), 1e-4);
    EXPECT_NEAR(distance.worst, 0.3, 1e-3);
}

TEST(NormalDistance, IgnoresSlidingInThePlane) {
    const TriangleMesh plane = shapes::square(4);
    const TriangleMesh slid =
        shapes::transformed(plane, Eigen::Affine3d(Eigen::Translation3d(5, 7, 0)));
    EXPECT_EQ(normal_distance(slid, plane).worst, 0);
}

TEST(NormalDistance, IsWeightedByAreaAndOmitsMarkedVertices) {
    // The lifted vertex belongs to two triangles.
    const TriangleMesh plane = shapes::square(2);
    TriangleMesh lifted = plane;
    const auto corner = static_cast<std::size_t>(
        std::find(plane.positions.begin(), plane.positions.end(), Vector3d::Zero()) -
        plane.positions.begin());
    lifted.positions[corner][2] = 1;
    const double share = 2.0 * (1.0 / 8) / 3;  // of the square's area 1
    EXPECT_NEAR(normal_distance(lifted, plane).rms, std::sqrt(share), 1e-15);

    std::vector<std::uint8_t> left_out(plane.positions.size());
    left_out[corner] = 1;
    const NormalDistance rest = normal_distance(lifted, plane, left_out);
    EXPECT_EQ(rest.worst, 0);
    EXPECT_NEAR(rest.covered, 1 - share, 1e-15);
}

TEST(VerticesAround, AreTheCornersOfTheTrianglesAndTheirNeighbours) {
    const TriangleMesh plane = shapes::square(10);
    std::vector<std::uint8_t> triangles(plane.triangles.size());
    triangles[0] = 1;  // (0, 0), (0.1, 0), (0.1, 0.1)
    const std::vector<std::uint8_t> around = vertices_around(plane, triangles);
    for (std::size_t i = 0; i < around.size(); ++i) {
        const Vector3d& p = plane.positions[i];
        // The farthest neighbours of (0.1, 0.1) and (0.1, 0) to the right and upwards.
        const bool near = std::max(p[0], p[1]) < 0.25 && p[1] - p[0] < 0.15;
        EXPECT_EQ(around[i] != 0, near) << p.transpose();
    }
    EXPECT_EQ(std::count(around.begin(), around.end(), 1), 8);
}

TEST(Diagonal, IgnoresVerticesThatNoTriangleUses) {
    TriangleMesh box = shapes::box(1, Vector3d(1, 2, 2));
    box.positions.emplace_back(100, 100, 100);
    EXPECT_DOUBLE_EQ(diagonal(box), 3);
}

}  // namespace
}  // namespace tracked_mcf
