// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/stair_removal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TEST(StairRemoval, ReportsCellsAndKeepsTheVolume) {
    const TriangleMesh ball = ball_of_marching_cubes(6);
    const NoiseReport report = report_of(ball);
    EXPECT_EQ(report.stop, NoiseStop::None);
    EXPECT_EQ(report.kind, NoiseKind::Stairs);
    EXPECT_NEAR(report.stairs, 1, 1e-6);
    EXPECT_NEAR(report.cell_x + report.cell_y + report.cell_z, 3, 1e-6);
    EXPECT_NEAR(report.voxels, shapes::volume(ball), 0.5);
    EXPECT_GT(report.smoothing_steps, 0);
    EXPECT_EQ(report.shrunken_parts, 0);
}

TEST(StairRemoval, OfOpenLabelsCountsNoCells) {
    TriangleMesh open = ball_of_faces(6);
    open.triangles.resize(open.triangles.size() - 2);
    const NoiseReport report = report_of(open);
    EXPECT_EQ(report.kind, NoiseKind::Stairs);
    EXPECT_TRUE(std::isnan(report.voxels));
}

// Nor does it tell of any, even if the user gives their size.
TEST(StairRemoval, SmoothsAndNamesNoStairsOfSmoothFields) {
    NoiseParameters parameters;
    for (const double size : {0, 1}) {
        parameters.noise_size = size;
        const NoiseReport report = report_of(symmetric_ball(), parameters);
        EXPECT_NE(report.kind, NoiseKind::Stairs);
        EXPECT_EQ(report.cell_x, 0);
        EXPECT_EQ(report.stairs, 0);
    }
}

TriangleMesh flight_of_stairs() {
    return shapes::voxels(0, 16, [](const Eigen::Vector3i& at) { return at[2] <= at[0]; });
}

TEST(StairRemoval, IsDoneOnModelsOnlyIfTheSizeMeansIt) {
    const NoiseReport unasked = report_of(flight_of_stairs());
    EXPECT_EQ(unasked.stop, NoiseStop::NoNoise);
    EXPECT_EQ(unasked.largest_displacement, 0);
    EXPECT_NEAR(unasked.stairs, 1, 1e-6) << "they are named";
    NoiseParameters parameters;
    parameters.noise_size = 1;
    EXPECT_EQ(report_of(flight_of_stairs(), parameters).kind, NoiseKind::Stairs);
    for (const double other : {0.4, 2.1}) {
        parameters.noise_size = other;
        EXPECT_EQ(report_of(ball_of_faces(6), parameters).cell_x, 0);
    }
    parameters.noise_size = 0;
    parameters.detail_size = 3;
    EXPECT_EQ(report_of(ball_of_faces(6), parameters).cell_x, 0);
}

TEST(StairRemoval, TreatsOtherPartsAsIfTheyWereAlone) {
    const TriangleMesh ball = ball_of_faces(6);
    const TriangleMesh noisy =
        with_noise(shapes::transformed(shapes::geodesic_sphere(12),
                                       Eigen::Translation3d(30, 0, 0) * Eigen::Scaling(8.0)),
                   0.2);
    const TriangleMesh together = denoised(shapes::merged(ball, noisy)), alone = denoised(noisy);
    double farthest = 0, moved = 0;
    for (std::size_t i = 0; i < noisy.positions.size(); ++i) {
        const Eigen::Vector3d& position = together.positions[ball.positions.size() + i];
        farthest = std::max(farthest, (position - alone.positions[i]).norm());
        moved = std::max(moved, (position - noisy.positions[i]).norm());
    }
    EXPECT_GT(moved, 0.1);
    EXPECT_LT(farthest, 1e-3 * moved);
    EXPECT_EQ(report_of(shapes::merged(ball, noisy)).kind, NoiseKind::Stairs);
}

TEST(StairRemoval, KeepsAModelBesideALabel) {
    const TriangleMesh ball = ball_of_marching_cubes(5);
    TriangleMesh both = shapes::merged(
        ball,
        shapes::transformed(flight_of_stairs(), Eigen::Affine3d(Eigen::Translation3d(20, 0.3, 0))));
    const TriangleMesh before = both;
    const NoiseReport report = remove_noise(both, {}, {});
    EXPECT_EQ(report.kind, NoiseKind::Stairs);
    for (std::size_t i = ball.positions.size(); i < both.positions.size(); ++i)
        ASSERT_EQ(both.positions[i], before.positions[i]);
}

}  // namespace
}  // namespace tracked_mcf
