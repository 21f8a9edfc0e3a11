// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/losses.h"

#include <gtest/gtest.h>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TEST(Losses, OfAPartThatShrinksAreThoseOfSquaresAndCubes) {
    const Eigen::Affine3d aside(Eigen::Translation3d(5, 0, 0));
    const TriangleMesh sphere = shapes::geodesic_sphere(6);
    const NoisySurface surface =
        surface_of_mesh(shapes::merged(sphere, shapes::transformed(sphere, aside)));
    const double middle = 0.5 * (surface.positions.front() + surface.positions.back())[0];
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double count = 0;
    for (const Eigen::Vector3d& p : surface.positions) {
        if (p[0] < middle) centre += p, ++count;
    }
    centre /= count;
    Positions after = surface.positions;
    for (Eigen::Vector3d& p : after) {
        if (p[0] < middle) p = centre + 0.9 * (p - centre);
    }
    const Losses losses = losses_of(surface, after, 0);
    EXPECT_EQ(losses.parts, 1);
    EXPECT_NEAR(losses.area, 1 - 0.9 * 0.9, 1e-9);
    EXPECT_NEAR(losses.volume, 1 - 0.9 * 0.9 * 0.9, 1e-9);
}

// A square with sides a spreads a² / 6 from its middle, and noise adds its variance.
TEST(Losses, AreNoneWithoutAMovementAndHardlyAnyOfNoise) {
    const TriangleMesh plane = shapes::square(20);
    const NoisySurface noisy = surface_of_mesh(with_noise(plane, 0.2));
    EXPECT_EQ(losses_of(noisy, noisy.positions, 0).parts, 0);
    Positions flat = noisy.positions;
    for (Eigen::Vector3d& p : flat) p[2] = 0;
    const Losses losses = losses_of(noisy, flat, 0);
    EXPECT_EQ(losses.parts, 0);
    const double side = (flat.back() - flat.front()).head<2>().cwiseAbs().maxCoeff();
    EXPECT_NEAR(losses.area, 0.04 / (side * side / 6), 2e-4);
}

TEST(Losses, LeaveOutPartsOfTheSizeOfRounding) {
    const NoisySurface surface = surface_of_mesh(shapes::geodesic_sphere(6));
    Positions after = surface.positions;
    for (Eigen::Vector3d& p : after) p *= 0.5;
    EXPECT_EQ(losses_of(surface, after, 1e-9).parts, 1);
    EXPECT_EQ(losses_of(surface, after, 1).parts, 0);
}

}  // namespace
}  // namespace tracked_mcf
