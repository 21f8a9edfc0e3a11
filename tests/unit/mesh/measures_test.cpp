// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(SurfaceArea, OfSquareAndBox) {
    EXPECT_NEAR(surface_area(shapes::square(7)), 1, 1e-14);
    EXPECT_NEAR(surface_area(shapes::box(3, {1, 2, 3})), 22, 1e-13);
}

TEST(MeanEdgeLength, IsThatOfTheSelectedTrianglesSides) {
    // A triangle of sides 3, 4, 5, and one with twice these sides. Both have the side of 4.
    const TriangleMesh mesh{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {-8, 0, 0}, {9, 9, 9}},
                            {{0, 1, 2}, {0, 2, 3}}};
    const double second = 4 + std::sqrt(80.0) + 8;
    EXPECT_NEAR(mean_edge_length(mesh), (12 + second) / 6, 1e-15);
    EXPECT_NEAR(mean_edge_length(mesh, {1, 0}), 4, 1e-15);
    EXPECT_NEAR(mean_edge_length(mesh, {0, 1}), second / 3, 1e-15);
    EXPECT_EQ(mean_edge_length(mesh, {0, 0}), 0);
    EXPECT_EQ(mean_edge_length(TriangleMesh()), 0);
    TriangleMesh with_collapsed = mesh;
    with_collapsed.triangles.push_back({0, 4, 4});
    EXPECT_EQ(mean_edge_length(with_collapsed), mean_edge_length(mesh));
}

TEST(SurfaceCentroid, OfABoxIsItsCentreEvenFarFromTheOrigin) {
    const Eigen::Vector3d far(1e6, -2e6, 3e6);
    const TriangleMesh box =
        shapes::transformed(shapes::box(3, {1, 2, 3}), Eigen::Affine3d(Eigen::Translation3d(far)));
    EXPECT_LT((shapes::surface_centroid(box) - far - Eigen::Vector3d(0.5, 1, 1.5)).norm(), 1e-9);
    EXPECT_NEAR(enclosed_volume(box), 6, 1e-8);
    EXPECT_NEAR(surface_area(box), 22, 1e-7);
}

TEST(EnclosedVolume, OfABoxIsTheProductOfItsSidesAndChangesSignWithTheNormals) {
    TriangleMesh box = shapes::box(3, {1, 2, 3});
    EXPECT_NEAR(enclosed_volume(box), 6, 1e-13);
    for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
    EXPECT_NEAR(enclosed_volume(box), -6, 1e-13);
}

TEST(SweptVolume, OfAPrismIsBaseTimesHeightAndPositiveAlongTheNormal) {
    const std::array<Eigen::Vector3d, 3> base = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}};
    std::array<Eigen::Vector3d, 3> moved = base;
    for (Eigen::Vector3d& corner : moved) corner += Eigen::Vector3d(5, -7, 0.5);
    EXPECT_NEAR(swept_volume(base, moved), 1.5, 1e-14);
    EXPECT_NEAR(swept_volume(moved, base), -1.5, 1e-14);
    std::swap(moved[0], moved[1]);
    EXPECT_NEAR(swept_volume({base[1], base[0], base[2]}, moved), -1.5, 1e-14);
}

TEST(SweptVolume, OfATetrahedronAndOfATriangleThatShrinksToAPoint) {
    // One corner rises by 4: a tetrahedron. All corners move to a point at height 4: a pyramid.
    const std::array<Eigen::Vector3d, 3> base = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}};
    EXPECT_NEAR(swept_volume(base, {Eigen::Vector3d(0, 0, 4), base[1], base[2]}), 4, 1e-14);
    const Eigen::Vector3d apex(1, 1, 4);
    EXPECT_NEAR(swept_volume(base, {apex, apex, apex}), 4, 1e-14);
}

TEST(SweptVolume, OfAClosedSurfaceIsTheChangeOfItsVolume) {
    // A motion that turns, stretches and bends.
    const TriangleMesh before = shapes::bumpy_sphere(6);
    TriangleMesh after = before;
    for (Eigen::Vector3d& p : after.positions) {
        p = {1 - p[1] + 0.3 * std::sin(2 * p[2]), 2 * p[0], p[2] * (1 + 0.5 * p[0])};
    }
    EXPECT_NEAR(volume_between(before, after), enclosed_volume(after) - enclosed_volume(before),
                1e-12);
    EXPECT_GT(std::abs(volume_between(before, after)), 1);
}

TEST(SweptVolume, OfAnOpenSurfaceLosesNoDigitsFarFromTheOrigin) {
    const TriangleMesh here = shapes::square(5);
    const Eigen::Affine3d far(Eigen::Translation3d(1e6, -2e6, 3e6));
    const TriangleMesh before = shapes::transformed(here, far);
    const TriangleMesh after =
        shapes::transformed(before, Eigen::Affine3d(Eigen::Translation3d(0, 0, 0.25)));
    EXPECT_NEAR(volume_between(before, after), 0.25, 1e-9);
}

TEST(IsThin, ComparesTheAreaWithTheSquareOfTheLongestEdge) {
    // The longest edge is 2, the area 4e-6.
    std::array<Eigen::Vector3d, 3> corners = {{{0, 0, 0}, {2, 0, 0}, {1, 4e-6, 0}}};
    for (int turn = 0; turn < 3; ++turn) {
        EXPECT_TRUE(is_thin(corners, 1.001e-6));
        EXPECT_FALSE(is_thin(corners, 0.999e-6));
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    EXPECT_TRUE(
        is_thin({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, 0));
}

}  // namespace
}  // namespace tracked_mcf
