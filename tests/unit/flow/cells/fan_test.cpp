// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/cubature.h"

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

}  // namespace
}  // namespace tracked_mcf
