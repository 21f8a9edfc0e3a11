// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/losses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

// The small part is far from the origin, where sums of squares and volumes would cancel.
TEST(Losses, OfAPartThatShrinksAreThoseOfSquaresAndCubes) {
    const TriangleMesh sphere = shapes::geodesic_sphere(6);
    for (const double size : {1.0, 1e-7}) {
        const Eigen::Affine3d aside(Eigen::Translation3d(5, 0, 0) * Eigen::Scaling(size));
        const Surface surface =
            surface_of(shapes::merged(shapes::transformed(sphere, aside), sphere));
        const double middle = 0.5 * (surface.positions.front() + surface.positions.back())[0];
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double count = 0;
        for (const Eigen::Vector3d& p : surface.positions) {
            if (p[0] > middle) centre += p, ++count;
        }
        centre /= count;
        Positions after = surface.positions;
        for (Eigen::Vector3d& p : after) {
            if (p[0] > middle) p = centre + 0.9 * (p - centre);
        }
        const std::vector<PartLoss> losses = losses_of(surface, after, 0);
        ASSERT_EQ(losses.size(), 2U);
        const auto [least, most] =
            std::minmax(losses[0], losses[1],
                        [](const PartLoss& a, const PartLoss& b) { return a.area < b.area; });
        EXPECT_TRUE(most.is_too_much());
        EXPECT_NEAR(most.area, 1 - 0.9 * 0.9, 1e-7);
        EXPECT_NEAR(most.volume, 1 - 0.9 * 0.9 * 0.9, 1e-7);
        EXPECT_EQ(most.turned, 0);
        EXPECT_FALSE(least.is_too_much());
        EXPECT_EQ(least.area, 0);
    }
}

// A square with sides a spreads a² / 6 from its middle, and noise adds its variance.
TEST(Losses, AreNoneWithoutAMovementAndHardlyAnyOfNoise) {
    const TriangleMesh plane = shapes::square(20);
    const Surface noisy = surface_of(with_noise(plane, 0.2));
    EXPECT_FALSE(losses_of(noisy, noisy.positions, 0)[0].is_too_much());
    Positions flat = noisy.positions;
    for (Eigen::Vector3d& p : flat) p[2] = 0;
    const PartLoss loss = losses_of(noisy, flat, 0)[0];
    EXPECT_FALSE(loss.is_too_much());
    const double added = 1 - surface_area(plane) / surface_area(with_noise(plane, 0.2));
    EXPECT_NEAR(loss.area_of_noise, 0.2 * added, 1e-3);
    const double side = (flat.back() - flat.front()).head<2>().cwiseAbs().maxCoeff();
    EXPECT_NEAR(loss.area, 0.04 / (side * side / 6), 2e-4);
}

TEST(Losses, OfAFoldedSheetAreTheAreaBehindIt) {
    constexpr int cells = 20, folded = 15;
    const Surface surface = surface_of(shapes::square(cells));
    Positions after = surface.positions;
    double left = after[0].x(), right = left;
    for (const Eigen::Vector3d& p : after) {
        left = std::min(left, p.x());
        right = std::max(right, p.x());
    }
    const double fold = left + (right - left) * folded / cells;
    for (Eigen::Vector3d& p : after) {
        if (p.x() > fold + 1e-9) p.x() = 2 * fold - p.x() + 1e-3 * (p.x() - fold);
    }
    // How far the sheet spreads tells it: the triangles of the fold are not turned beside each
    // other.
    const PartLoss loss = losses_of(surface, after, 0)[0];
    EXPECT_TRUE(loss.is_too_much());
    EXPECT_GT(loss.area, 0.2);
}

TEST(Losses, OfNoiseInTheVolumeAreNone) {
    const TriangleMesh icosahedron = shapes::geodesic_sphere(1);
    const Surface surface = surface_of(with_noise(icosahedron, 0.1));
    Positions after = surface.positions;
    const Eigen::Vector3d middle = surface.box.center() / surface.edge;
    for (Eigen::Vector3d& p : after) p = (p + middle).normalized() / surface.edge - middle;
    const PartLoss loss = losses_of(surface, after, 0)[0];
    EXPECT_GT(loss.volume, 0.03);
    EXPECT_LT(loss.volume, loss.volume_of_noise);
}

TEST(Losses, LeaveOutPartsOfTheSizeOfRounding) {
    const Surface surface = surface_of(shapes::geodesic_sphere(6));
    Positions after = surface.positions;
    for (Eigen::Vector3d& p : after) p *= 0.5;
    EXPECT_TRUE(losses_of(surface, after, 1e-9)[0].is_too_much());
    EXPECT_FALSE(losses_of(surface, after, 1)[0].is_too_much());
}

}  // namespace
}  // namespace tracked_mcf
