#include "filter_tracked_mcf/core/cubature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/fan.h"

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

/// A regular pentagon, with corner tags that whole_triangle would give to a triangle around it.
Polygon pentagon() {
    Polygon polygon;
    for (int i = 0; i < 5; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / 5;
        polygon.add({std::cos(angle), std::sin(angle), 0}, Polygon::kNone, Polygon::kNone);
    }
    return polygon;
}

TEST(Fan, WeightsAddUpToThePolygonsArea) {
    const std::array<Eigen::Vector3d, 3> triangle = {{{-3, -2, 0}, {3, -2, 0}, {0, 4, 0}}};
    double area = 0;
    for_each_node(pentagon(), triangle, cubature_rule(Cubature::ThreePoints),
                  [&](const WeightedPoint& node) { area += node.weight; });
    EXPECT_NEAR(area, 2.5 * std::sin(2 * std::acos(-1.0) / 5), 1e-15);
}

TEST(Fan, ApexDoesNotDependOnWhereThePolygonStarts) {
    const std::array<Eigen::Vector3d, 3> triangle = {{{-3, -2, 0}, {3, -2, 0}, {0, 4, 0}}};
    const Polygon polygon = pentagon();
    const Eigen::Vector3d apex = polygon.points[fan_apex(polygon, triangle)];
    for (int shift = 1; shift < 5; ++shift) {
        Polygon shifted;
        for (int i = 0; i < 5; ++i) shifted.add(polygon.points[(i + shift) % 5], -1, -1);
        EXPECT_EQ(shifted.points[fan_apex(shifted, triangle)], apex);
    }
}

}  // namespace
}  // namespace tracked_mcf
