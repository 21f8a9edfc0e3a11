// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/cells/cubature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tracked_mcf {
namespace {

/// A regular pentagon.
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

TEST(Fan, NodesIntegrateQuadraticsExactlyWhateverTheApex) {
    // By symmetry ∫ x² is half the polar moment, which is 5/12 sin 72° (2 + cos 72°).
    const double angle = 2 * std::acos(-1.0) / 5;
    const double polar = 5.0 / 12 * std::sin(angle) * (2 + std::cos(angle));
    for (const double turn : {0.0, 1.0, 2.0}) {
        std::array<Eigen::Vector3d, 3> triangle;
        for (int i = 0; i < 3; ++i) {
            const double at = turn + i * 2 * std::acos(-1.0) / 3;
            triangle[i] = 4 * Eigen::Vector3d(std::cos(at), std::sin(at), 0);
        }
        double sum = 0;
        for_each_node(
            pentagon(), triangle, cubature_rule(Cubature::ThreePoints),
            [&](const WeightedPoint& node) { sum += node.weight * node.point[0] * node.point[0]; });
        EXPECT_NEAR(sum, polar / 2, 1e-14);
    }
}

using Moments = Eigen::Matrix4d;

/// Returns the sum of the nodes' weights times the products of 1, x, y and z.
template <class Nodes>
Moments moments_of(const Nodes& nodes) {
    Moments moments = Moments::Zero();
    for (const WeightedPoint& node : nodes) {
        const Eigen::Vector4d x = node.point.homogeneous();
        moments += node.weight * x * x.transpose();
    }
    return moments;
}

/// A triangle in no special position.
const std::array<Eigen::Vector3d, 3> kOblique = {
    {{1.2, 3.1, 0.4}, {3.9, 1.7, 2.2}, {0.3, 2.6, 3.8}}};

/// Returns a polygon inside kOblique, with its corners at these barycentric coordinates.
Polygon inside_oblique(const std::vector<Eigen::Vector3d>& corners) {
    Polygon polygon;
    for (const Eigen::Vector3d& b : corners) {
        polygon.add(b[0] * kOblique[0] + b[1] * kOblique[1] + b[2] * kOblique[2], Polygon::kNone,
                    Polygon::kNone);
    }
    return polygon;
}

Polygon oblique_pentagon() {
    return inside_oblique(
        {{0.8, 0.1, 0.1}, {0.5, 0.4, 0.1}, {0.1, 0.6, 0.3}, {0.1, 0.2, 0.7}, {0.4, 0.1, 0.5}});
}

TEST(WholePolygon, NodesIntegrateQuadraticsExactly) {
    std::vector<WeightedPoint> fan;
    for_each_node(oblique_pentagon(), kOblique, cubature_rule(Cubature::Degree6),
                  [&](const WeightedPoint& node) { fan.push_back(node); });
    const Moments expected = moments_of(fan);
    const Moments moments = moments_of(nodes_of_whole(oblique_pentagon(), kOblique));
    EXPECT_LT((moments - expected).norm(), 1e-13 * expected.norm());
}

TEST(WholePolygon, NodesLieInside) {
    const Polygon polygon = oblique_pentagon();
    const Eigen::Vector3d normal = twice_vector_area(kOblique[0], kOblique[1], kOblique[2]);
    for (const WeightedPoint& node : nodes_of_whole(polygon, kOblique)) {
        EXPECT_NEAR(normal.normalized().dot(node.point - kOblique[0]), 0, 1e-14);
        for (int i = 0; i < polygon.size; ++i) {
            const Eigen::Vector3d& from = polygon.points[i];
            const Eigen::Vector3d side = polygon.points[polygon.next(i)] - from;
            EXPECT_GT(normal.dot(side.cross(node.point - from)), 0);
        }
    }
}

TEST(WholePolygon, NodesTurnWithTheAxes) {
    const auto turned = [](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(p[1], -p[2], -p[0]);
    };
    Polygon polygon = oblique_pentagon();
    std::array<Eigen::Vector3d, 3> triangle = kOblique;
    const auto nodes = nodes_of_whole(polygon, triangle);
    for (Eigen::Vector3d& point : polygon.points) point = turned(point);
    for (Eigen::Vector3d& corner : triangle) corner = turned(corner);
    const auto turned_nodes = nodes_of_whole(polygon, triangle);
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT((turned_nodes[i].point - turned(nodes[i].point)).norm(), 1e-14);
    }
}

TEST(WholePolygon, OfALineHasFinitePointsAndNoArea) {
    const Polygon line =
        inside_oblique({{0.8, 0.1, 0.1}, {0.6, 0.2, 0.2}, {0.4, 0.3, 0.3}, {0.6, 0.2, 0.2}});
    for (const WeightedPoint& node : nodes_of_whole(line, kOblique)) {
        EXPECT_GE(node.weight, 0);
        EXPECT_LT(node.weight, 1e-15);
        EXPECT_TRUE(node.point.allFinite());
        EXPECT_LT((node.point - line.points[1]).norm(), 0.5);
    }
}

TEST(WholePolygon, IsSmallUpToHalfACell) {
    Polygon polygon = pentagon();  // its extents are 1.81 and 1.90
    for (Eigen::Vector3d& point : polygon.points) point *= 0.26;
    EXPECT_TRUE(is_small(polygon));
    for (Eigen::Vector3d& point : polygon.points) point *= 1.02;
    EXPECT_FALSE(is_small(polygon));
}

}  // namespace
}  // namespace tracked_mcf
