// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/noise/turns.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

Evidence evidence_of(const TriangleMesh& mesh) {
    return evidence_of(sample_of(surface_of_mesh(mesh), 16000, {}, 250), crease_of(25), 1e-12);
}

TEST(Evidence, OfWhiteNoiseIsAsHighInAllStepsAndEverywhere) {
    const Evidence evidence = evidence_of(with_noise(shapes::geodesic_sphere(30), 0.2));
    EXPECT_NEAR(evidence.height, 0.18, 0.02) << "of the quiet quarter";
    EXPECT_NEAR(evidence.rise, 1, 0.06);
    EXPECT_NEAR(evidence.growth, 1, 0.1);
    EXPECT_NEAR(evidence.evenness, 0.9, 0.05);
    EXPECT_NEAR(evidence.skewness, 0, 0.15);
    EXPECT_NEAR(evidence.kurtosis, 2.8, 0.2);
    EXPECT_NEAR(evidence.stillness, 1, 0.1);
    EXPECT_FALSE(evidence.is_white_in_places);
    EXPECT_FALSE(is_pattern(evidence, NoiseKind::White));
    EXPECT_EQ(shared_noise_of(evidence, false).width, 0);
}

TEST(Evidence, OfNoiseThatNeighboursShareGivesItsWidthAndHeight) {
    for (const int averagings : {1, 2}) {
        const Evidence evidence =
            evidence_of(with_shared_noise(shapes::geodesic_sphere(30), 0.2, averagings));
        const SharedNoise noise = shared_noise_of(evidence, false);
        EXPECT_GT(noise.width, 1.6) << averagings;
        EXPECT_LT(noise.width, 3.4) << averagings;
        EXPECT_NEAR(noise.height, 0.2, 0.07) << averagings;
        EXPECT_GT(evidence.rise, 1.15) << averagings;
    }
}

TEST(Evidence, OfNoiseInOnePlaceIsWhiteThere) {
    const TriangleMesh clean = shapes::geodesic_sphere(40), noisy = with_noise(clean, 0.3);
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0.8, 0), Eigen::Vector3d(-0.6, 0, 0.8)}) {
        TriangleMesh mesh = clean;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            if (clean.positions[i].dot(direction) > 0.8) mesh.positions[i] = noisy.positions[i];
        }
        EXPECT_TRUE(evidence_of(mesh).is_white_in_places);
    }
    EXPECT_FALSE(evidence_of(clean).is_white_in_places);
}

/// Returns a square of 80 x 80 cells with heights, in edges, that depend on the cell.
template <class Height>
TriangleMesh relief(const Height& height) {
    constexpr int cells = 80;
    TriangleMesh mesh = shapes::square(cells);
    const double edge = mean_edge_length(mesh);
    const Eigen::Vector3d first = mesh.positions.front(), last = mesh.positions.back();
    const double cell = (last - first).head<2>().cwiseAbs().maxCoeff() / cells;
    for (Eigen::Vector3d& p : mesh.positions)
        p.z() = edge * height((p.x() - first.x()) / cell, (p.y() - first.y()) / cell);
    return mesh;
}

// All of them are even, but waves of one length have less kurtosis than noise, or stop growing.
TEST(Evidence, OfPatternsIsNotThatOfNoise) {
    constexpr double turn = 6.283185307179586;
    const auto wave = [](double x, double length) { return std::sin(turn * x / length); };
    const auto is_within = [](double x, double period, double width) {
        return x - period * std::floor(x / period + 1e-9) < width;
    };
    for (const TriangleMesh& mesh :
         {relief([&](double x, double y) { return 0.3 * wave(x, 5.3) * wave(y, 5.3); }),
          relief([&](double x, double y) { return 0.3 * wave(0.6 * x + 0.8 * y, 6); }),
          relief([&](double x, double y) {
              return is_within(x, 16, 1.5) || is_within(y, 8, 1.5) ? -0.3 : 0.0;
          })}) {
        const Evidence evidence = evidence_of(mesh);
        EXPECT_EQ(shared_noise_of(evidence, false).width, 0);
        EXPECT_TRUE(is_pattern(evidence, NoiseKind::White));
    }
}

TEST(Evidence, IsNoneOfFewVertices) {
    const Evidence evidence = evidence_of(shapes::box(2, {1, 1, 1}));
    EXPECT_EQ(evidence.height, 0);
    EXPECT_EQ(lumps_of(evidence).width, 0);
}

}  // namespace
}  // namespace tracked_mcf
