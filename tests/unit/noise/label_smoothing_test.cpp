// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/label_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/noise/turns.h"
#include "tests/support/measures.h"
#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// A mesh of one label, the label, and what smoothing makes of it.
struct Case {
    explicit Case(const TriangleMesh& label_mesh)
        : mesh(label_mesh),
          labels(labels_of(surface_of_mesh(mesh), {whole_of(surface_of_mesh(mesh))}).at(0)),
          smooth(without_stairs(labels, crease_of(25), false)) {
        after = mesh;
        const double edge = mean_edge_length(mesh);
        const Surface surface = surface_of(mesh);
        for (std::size_t i = 0; i < after.positions.size(); ++i)
            after.positions[i] = surface.box.center() + edge * smooth.positions[i];
    }

    bool is_certain() const { return smooth.are_certain.at(0) != 0; }

    TriangleMesh mesh;
    Labels labels;
    SmoothLabels smooth;
    TriangleMesh after;
};

/// Returns the standard deviation of the distances from the middle of a ball.
double roughness(const TriangleMesh& mesh, const Eigen::Vector3d& middle) {
    double sum = 0, squares = 0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const double distance = (position - middle).norm();
        sum += distance;
        squares += distance * distance;
    }
    const auto count = static_cast<double>(mesh.positions.size());
    return std::sqrt(squares / count - sum / count * sum / count);
}

TEST(LabelSmoothing, LeavesABallWithinHalfACellAndWithItsVolume) {
    const Eigen::Vector3d middle(-0.31, -0.12, 0.23);
    for (const double radius : {2.3, 4.0, 9.0}) {
        const Case marching(ball_of_marching_cubes(radius));
        const Case faces(ball_of_faces(radius));
        for (const Case* const label : {&marching, &faces}) {
            EXPECT_TRUE(label->is_certain());
            for (std::size_t i = 0; i < label->mesh.positions.size(); ++i) {
                const Eigen::Vector3d moved = label->after.positions[i] - label->mesh.positions[i];
                EXPECT_LT(moved.lpNorm<Eigen::Infinity>(), 0.5 + 1e-9);
            }
            EXPECT_NEAR(shapes::volume(label->after) / shapes::volume(label->mesh), 1, 0.002);
        }
        EXPECT_LT(roughness(marching.after, middle), 0.7 * roughness(marching.mesh, middle));
        const Eigen::Vector3d corner = middle + Eigen::Vector3d::Constant(0.5);
        EXPECT_LT(roughness(faces.after, corner), 0.5 * roughness(faces.mesh, corner));
    }
}

TEST(LabelSmoothing, SmoothsAveragedLabelsButNoSmoothFields) {
    const Eigen::Vector3d middle(-0.31, -0.12, 0.23);
    const Case ball(averaged_ball(9));
    EXPECT_TRUE(ball.is_certain());
    EXPECT_LT(roughness(ball.after, middle), 0.5 * roughness(ball.mesh, middle));
    EXPECT_NEAR(shapes::volume(ball.after) / shapes::volume(ball.mesh), 1, 0.002);
    const Case field(symmetric_ball());
    EXPECT_TRUE(field.labels.lattice.is_soft);
    EXPECT_FALSE(field.is_certain());
}

// A ball of cells, as a grid that is turned and twice as fine has it.
TEST(LabelSmoothing, FindsCellsThatAreLargerThanThoseOfTheGrid) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    const auto cell_at = [&](const Eigen::Vector3i& at) -> Eigen::Vector3i {
        return (turn * at.cast<double>() / 2).array().round().matrix().cast<int>();
    };
    const Case ball(shapes::marching_cubes(
        -20, 20, [&](const Eigen::Vector3i& at) { return in_ball(8)(cell_at(at)); }));
    EXPECT_TRUE(ball.is_certain());
    EXPECT_GE(ball.smooth.cells, 2);
    EXPECT_LE(ball.smooth.cells, 2.5) << "places are rounded to the finer grid, too";
    const Eigen::Vector3d middle = 2 * turn.transpose() * Eigen::Vector3d(-0.31, -0.12, 0.23);
    EXPECT_LT(roughness(ball.after, middle), 0.4 * roughness(ball.mesh, middle));
    const auto terraces = [](const Eigen::Vector3i& at) {
        const int level = at[2] / 3 * 3;
        return level >= 0 && std::hypot(at[0], at[1]) + level < 18;
    };
    EXPECT_EQ(Case(shapes::marching_cubes(-18, 18, terraces)).smooth.cells, 1);
}

TEST(LabelSmoothing, KeepsFlatSidesAndHeldVertices) {
    const TriangleMesh disc = shapes::voxels(-12, 12, [](const Eigen::Vector3i& at) {
        return std::hypot(at[0] + 0.3, at[1] - 0.2) < 10 && std::abs(at[2]) < 3;
    });
    Case label(disc);
    for (std::size_t i = 0; i < disc.positions.size(); ++i) {
        if (std::abs(disc.positions[i][2] - 0.5) == 2.5) {
            EXPECT_NEAR(label.after.positions[i][2], disc.positions[i][2], 1e-9);
        }
    }
    label.labels.surface.fidelity[0] = 0;
    const SmoothLabels smooth = without_stairs(label.labels, 0, true);
    const Eigen::Vector3d start =
        label.labels.lattice.cell * label.labels.surface.positions[0] + label.labels.lattice.origin;
    EXPECT_LT((smooth.positions[0] - start).norm(), 1e-9);
}

TEST(LabelSmoothing, IsUncertainOfModelsOfSteps) {
    const auto flight = [](const Eigen::Vector3i& at) { return at[2] <= at[0]; };
    EXPECT_FALSE(Case(shapes::voxels(0, 16, flight)).is_certain());
    const auto pyramid = [](const Eigen::Vector3i& at) {
        return std::max(std::abs(at[0]), std::abs(at[1])) + at[2] < 10 && at[2] >= 0;
    };
    EXPECT_FALSE(Case(shapes::voxels(-10, 10, pyramid)).is_certain());
    const auto block = [](const Eigen::Vector3i& at) { return at.sum() % 2 == 0 || at[2] < 0; };
    EXPECT_FALSE(Case(shapes::voxels(-6, 6, block)).is_certain());
}

// A cube of eight voxels beside a ball.
TEST(LabelSmoothing, JudgesSmallPartsByTheLargest) {
    const auto small = [](const Eigen::Vector3i& at) {
        return at.minCoeff() >= 8 && at.maxCoeff() < 10;
    };
    const TriangleMesh both = shapes::voxels(
        -10, 11, [&](const Eigen::Vector3i& at) { return in_ball(6)(at) || small(at); });
    const Surface surface = surface_of(both);
    const NoisySurface noisy{surface.stars, surface.positions,
                             std::vector<float>(surface.positions.size(), 1)};
    const std::vector<Labels> labels = labels_of(noisy, part_ranges(noisy.stars, surface.parts));
    ASSERT_EQ(labels.size(), 1U);
    const SmoothLabels smooth = without_stairs(labels[0], crease_of(25), false);
    EXPECT_EQ(smooth.are_certain, (std::vector<std::uint8_t>{1, 1}));
}

}  // namespace
}  // namespace tracked_mcf
