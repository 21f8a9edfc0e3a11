// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/pi.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

constexpr double kRimCrease = 0.5;

TEST(Rim, OfASquareKeepsItsSidesAndCorners) {
    const NoisySurface surface = surface_of_mesh(shapes::square(20));
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : surface.positions) box.extend(p);
    const auto distance_from_square = [&](double crease) {
        Positions positions = surface.positions;
        smooth_rim(surface, crease, confinement(positions), positions);
        double largest = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (surface.stars.on_rim[i] == 0) {
                EXPECT_EQ(positions[i], surface.positions[i]);
                continue;
            }
            const Eigen::Vector3d &p = positions[i], nearest = p.cwiseMax(box.min());
            const double beyond = (p - nearest.cwiseMin(box.max())).norm();
            const double inside = (p - box.min()).cwiseMin(box.max() - p).head<2>().minCoeff();
            largest = std::max({largest, beyond, inside});
        }
        return largest;
    };
    EXPECT_LT(distance_from_square(kRimCrease), 0.1 * distance_from_square(0));
}

// Linear elements on a regular curve with sides h have the eigenvalue 2 (1 - cos φ) / h² for a wave
// with the phase φ per side.
TEST(Rim, HalvesWavesOfTenEdges) {
    const int sides = 200, waves = sides / 10;
    const TriangleMesh ring = shapes::annulus(sides, 4, 0.9, 1);
    NoisySurface surface = surface_of_mesh(ring);
    const double edge = mean_edge_length(ring);
    const auto on_outer_rim = [&](const Eigen::Vector3d& p) {
        return std::abs(edge * p.head<2>().norm() - 1) < 1e-9;
    };
    const auto wave = [&](const Eigen::Vector3d& p) {
        return std::cos(waves * std::atan2(p[1], p[0]));
    };
    Positions positions = surface.positions;
    for (Eigen::Vector3d& p : positions) {
        if (on_outer_rim(p)) p[2] += 0.01 * wave(p);
    }
    smooth_rim(surface, 0, confinement(positions), positions);
    double kept = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (on_outer_rim(surface.positions[i]))
            kept += positions[i][2] * wave(surface.positions[i]) * 2 / sides / 0.01;
    }
    const double h = 2 * std::sin(kPi / sides) / edge;
    const double eigenvalue = 2.4 * 2 * (1 - std::cos(2 * kPi / 10)) / (h * h);
    EXPECT_NEAR(kept, 1 / (1 + eigenvalue * eigenvalue), 1e-3);
}

TEST(Rim, KeepsFixedVertices) {
    NoisySurface surface = surface_of_mesh(with_isotropic_noise(shapes::square(10), 0.2));
    const auto first = static_cast<std::size_t>(
        std::find(surface.stars.on_rim.begin(), surface.stars.on_rim.end(), 1) -
        surface.stars.on_rim.begin());
    surface.fidelity[first] = 0;
    Positions positions = surface.positions;
    smooth_rim(surface, kRimCrease, confinement(positions), positions);
    EXPECT_EQ(positions[first], surface.positions[first]);
    EXPECT_NE(positions, surface.positions);
}

}  // namespace
}  // namespace tracked_mcf
