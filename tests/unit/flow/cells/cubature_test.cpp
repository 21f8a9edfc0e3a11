// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/cubature.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace tracked_mcf {
namespace {

double factorial(int n) {
    return std::tgamma(n + 1.0);
}

/// Largest error of a rule over the monomials of barycentric coordinates of this degree, whose mean
/// over the triangle is 2 a! b! c! / (a + b + c + 2)!.
double largest_error(Cubature cubature, int degree) {
    double largest = 0;
    for (int a = 0; a <= degree; ++a) {
        for (int b = 0; a + b <= degree; ++b) {
            const int c = degree - a - b;
            double sum = 0;
            for (const CubatureNode& node : cubature_rule(cubature)) {
                const auto& x = node.barycentric;
                sum += node.weight * std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], c);
            }
            const double exact =
                2 * factorial(a) * factorial(b) * factorial(c) / factorial(degree + 2);
            largest = std::max(largest, std::abs(sum - exact));
        }
    }
    return largest;
}

void expect_exact_to(Cubature cubature, int degree) {
    for (int d = 0; d <= degree; ++d) EXPECT_LT(largest_error(cubature, d), 1e-14) << d;
    EXPECT_GT(largest_error(cubature, degree + 1), 1e-6);
}

TEST(Cubature, OnePointIsExactToDegree1) {
    expect_exact_to(Cubature::OnePoint, 1);
}
TEST(Cubature, ThreePointsAreExactToDegree2) {
    expect_exact_to(Cubature::ThreePoints, 2);
}
TEST(Cubature, Degree6IsExactToDegree6) {
    expect_exact_to(Cubature::Degree6, 6);
}

TEST(Cubature, ThreePointsLieHalfWayFromCornersToCentroid) {
    const auto& rule = cubature_rule(Cubature::ThreePoints);
    ASSERT_EQ(rule.size(), 3U);
    for (int corner = 0; corner < 3; ++corner) {
        const Eigen::Vector3d half_way =
            0.5 * (Eigen::Vector3d::Unit(corner) + Eigen::Vector3d::Constant(1.0 / 3));
        EXPECT_TRUE(rule[corner].barycentric.isApprox(half_way, 1e-15));
    }
}

TEST(Cubature, NodesLieInsideWithPositiveWeights) {
    for (const Cubature cubature : {Cubature::OnePoint, Cubature::ThreePoints, Cubature::Degree6}) {
        for (const CubatureNode& node : cubature_rule(cubature)) {
            EXPECT_GT(node.weight, 0);
            EXPECT_GT(node.barycentric.minCoeff(), 0);
        }
    }
}

// The longest side is the first one, so the corner opposite to it is the third.
TEST(Cubature, FansBeginNearestToTheCornerOppositeToTheLongestSide) {
    const std::array<Eigen::Vector3d, 3> triangle = {{{0, 0, 0}, {0.9, 0, 0}, {0.4, 0.3, 0}}};
    Polygon polygon;
    for (const Eigen::Vector3d& corner : triangle) polygon.points[polygon.size++] = corner;
    EXPECT_EQ(fan_apex(polygon, triangle), 2);
    polygon.points[polygon.size++] = triangle[2];
    EXPECT_EQ(fan_apex(polygon, triangle), 2) << "of two points at one place, the first";
}

}  // namespace
}  // namespace tracked_mcf
