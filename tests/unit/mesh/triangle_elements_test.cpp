// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

Stars stars_of(const TriangleMesh& mesh) {
    return {RawVector<Triangle>(mesh.triangles.begin(), mesh.triangles.end()),
            static_cast<std::int32_t>(mesh.positions.size())};
}

TriangleElements in_own_metric(const TriangleMesh& mesh, const std::vector<float>& densities = {}) {
    return elements_in_own_metric(stars_of(mesh), mesh.positions, densities);
}

bool same_elements(const TriangleElement<float>& a, const TriangleElement<float>& b) {
    return a.weights == b.weights && a.mass == b.mass;
}

/// Expects that the cotangents α, β, γ are those of a triangle: αβ + βγ + γα = 1. Expects that they
/// are at most `largest`.
void expect_triangle(const TriangleElement<float>& element, double largest) {
    const double a = 2 * double{element.weights[0]}, b = 2 * double{element.weights[1]},
                 c = 2 * double{element.weights[2]};
    EXPECT_NEAR(a * b + b * c + c * a, 1, 1e-6 * largest * largest);
    for (const double cotangent : {a, b, c}) EXPECT_LE(std::abs(cotangent), largest);
    EXPECT_GT(element.mass, 0);
    EXPECT_TRUE(std::isfinite(element.mass));
}

TEST(TriangleElements, WeightsAreHalfTheCotangentsOfAKnownTriangle) {
    // The foot of the height splits the base into 1 and 3, and the height is 2.
    const TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {1, 2, 0}}, {{0, 1, 2}}};
    const TriangleElement<float> element = in_own_metric(mesh)[0];
    EXPECT_FLOAT_EQ(element.weights[0], 0.5F * 1 / 2);
    EXPECT_FLOAT_EQ(element.weights[1], 0.5F * 3 / 2);
    EXPECT_FLOAT_EQ(element.weights[2], 0.5F * (2 * 2 - 1 * 3) / (2 * (1 + 3)));
    EXPECT_FLOAT_EQ(element.mass, 4.0F / 3);
    EXPECT_FLOAT_EQ(in_own_metric(mesh, {2.5F})[0].mass, 2.5F * 4 / 3);
    EXPECT_EQ(in_own_metric(mesh, {2.5F})[0].weights, element.weights);
}

TEST(TriangleElements, AnObtuseCornerHasANegativeWeight) {
    const TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {-1, 1, 0}}, {{0, 1, 2}}};
    const TriangleElement<float> element = in_own_metric(mesh)[0];
    EXPECT_FLOAT_EQ(element.weights[0], -0.5F);
    EXPECT_FLOAT_EQ(element.weights[1], 1.5F);
    EXPECT_FLOAT_EQ(element.weights[2], 1.0F);
}

TEST(TriangleElements, DoNotDependOnTheOrderOfCornersOrOnTheUnit) {
    const TriangleMesh mesh = shapes::bumpy_sphere(4);
    TriangleMesh other =
        shapes::transformed(shapes::inside_out(mesh), Eigen::Affine3d(Eigen::Scaling(1024.0)));
    for (Triangle& t : other.triangles) t = {t[2], t[0], t[1]};
    const TriangleElements expected = in_own_metric(mesh), elements = in_own_metric(other);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        EXPECT_FLOAT_EQ(elements[i].mass, expected[i].mass * 1024 * 1024);
        for (int k = 0; k < 3; ++k) {
            for (int l = 0; l < 3; ++l) {
                if (other.triangles[i][k] != mesh.triangles[i][l]) continue;
                EXPECT_FLOAT_EQ(elements[i].weights[k], expected[i].weights[l]);
            }
        }
    }
}

TEST(TriangleElements, LongRightTrianglesAreTakenAsTheyAre) {
    for (const double length : {1.0, 60.0, 300.0, 900.0}) {
        const TriangleMesh mesh{{{0, 0, 0}, {length, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
        const TriangleElement<float> element = in_own_metric(mesh)[0];
        EXPECT_NEAR(element.weights[0], 0, 1e-6 * length);
        EXPECT_NEAR(element.weights[1], length / 2, 1e-6 * length);
        EXPECT_NEAR(element.weights[2], 0.5 / length, 1e-6);
        EXPECT_NEAR(element.mass, length / 6, 1e-6 * length);
    }
}

// All sides become longer by up to a thousandth of the longest, or 0.03 of the shortest.
TEST(TriangleElements, OfNeedlesAndOfTrianglesWithoutAnAreaAreThoseOfATriangle) {
    const double nearly_zero = 1e-30;
    const TriangleMesh base = shapes::square(4);
    struct Needle {
        Eigen::Vector3d apex;
        double largest;  // cotangent
    };
    for (const auto& [apex, largest] : {
             Needle{{0.25, 0, 0}, 1001},          // coincides with a corner
             Needle{{0.35, 0, 0}, 10},            // lies on the opposite side
             Needle{{0.35, 0, nearly_zero}, 10},  // is a needle
             Needle{{0.75, 0, 0}, 10},            // lies beyond a corner
         }) {
        TriangleMesh mesh = base;
        const auto last = static_cast<std::int32_t>(mesh.positions.size());
        std::int32_t first = -1, second = -1;
        for (std::int32_t i = 0; i < last; ++i) {
            if (mesh.positions[i].isApprox(Eigen::Vector3d(0.25, 0, 0))) first = i;
            if (mesh.positions[i].isApprox(Eigen::Vector3d(0.5, 0, 0))) second = i;
        }
        ASSERT_TRUE(first >= 0 && second >= 0);
        mesh.positions.push_back(apex);
        mesh.triangles.push_back({first, second, last});
        SCOPED_TRACE(apex.transpose());
        expect_triangle(in_own_metric(mesh).back(), largest);
    }
}

TEST(TriangleElements, OfASurfaceOfASinglePointAreFinite) {
    TriangleMesh mesh = shapes::geodesic_sphere(3);
    for (Eigen::Vector3d& position : mesh.positions) position = {1, 2, 3};
    for (const TriangleElement<float>& element : in_own_metric(mesh)) {
        for (const float weight : element.weights) {
            EXPECT_FLOAT_EQ(weight, 0.5F / std::sqrt(3.0F)) << "an equilateral triangle";
        }
        EXPECT_GT(element.mass, 0);
        EXPECT_LT(element.mass, 1e-12F);
    }
}

TEST(TriangleElements, KeepTheirBitsIfANeedleIsFarAway) {
    const TriangleMesh mesh = shapes::square(10);
    TriangleMesh with_needle = mesh;
    std::size_t corner = 0;  // of the square
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i].sum() < mesh.positions[corner].sum()) corner = i;
    }
    // Moves the corner's neighbour onto the corner.
    std::size_t moved = corner;
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) {
            if ((mesh.positions[vertex] - Eigen::Vector3d(0.1, 0, 0)).norm() < 1e-9) {
                moved = static_cast<std::size_t>(vertex);
            }
        }
    }
    ASSERT_NE(moved, corner);
    with_needle.positions[moved] = mesh.positions[corner];
    const TriangleElements expected = in_own_metric(mesh), elements = in_own_metric(with_needle);
    int changed = 0, around = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const bool has_moved = t[0] == static_cast<std::int32_t>(moved) ||
                               t[1] == static_cast<std::int32_t>(moved) ||
                               t[2] == static_cast<std::int32_t>(moved);
        around += has_moved ? 1 : 0;
        EXPECT_TRUE(has_moved || same_elements(elements[i], expected[i])) << i;
        changed += same_elements(elements[i], expected[i]) ? 0 : 1;
    }
    EXPECT_EQ(changed, around);
}

}  // namespace
}  // namespace tracked_mcf
