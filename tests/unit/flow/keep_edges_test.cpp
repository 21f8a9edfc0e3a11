// SPDX-License-Identifier: GPL-3.0-or-later
// Flows that keep edges (FlowParameters::keep_edges).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

constexpr int kQuads = 16;
constexpr double kEdge = 1.0 / kQuads;

FlowParameters keeping(double angle, double detail_in_edges = 3) {
    FlowParameters p;
    p.keep_edges = angle;
    p.detail_size = detail_in_edges * kEdge;
    p.order = 2;
    return p;
}

/// The distance of a point from the unit cube's surface.
double distance_to_cube(const Eigen::Vector3d& point) {
    const Eigen::Array3d beyond = (point.array() - 0.5).abs() - 0.5;
    return std::abs(beyond.max(0).matrix().norm() + std::min(beyond.maxCoeff(), 0.0));
}

double rms_to_cube(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const double distance = distance_to_cube(position);
        sum += distance * distance;
    }
    return std::sqrt(sum / static_cast<double>(mesh.positions.size()));
}

TEST(KeepEdges, RemovesTheNoiseOfACubeAndKeepsItsEdges) {
    const TriangleMesh cube = noisy(shapes::box(kQuads, {1, 1, 1}), 0.3 * kEdge);
    const double before = rms_to_cube(cube);
    const double kept = rms_to_cube(evolved(cube, keeping(25)));
    EXPECT_LT(kept, 0.45 * before);
    // The best flow without edges leaves more.
    double best = before;
    for (const double edges : {3.0, 4.0, 6.0}) {
        best = std::min(best, rms_to_cube(evolved(cube, keeping(0, edges))));
    }
    EXPECT_LT(kept, 0.8 * best);
}

TEST(KeepEdges, HardlyMovesACleanCube) {
    const TriangleMesh cube = shapes::box(kQuads, {1, 1, 1});
    EXPECT_LT(rms_to_cube(evolved(cube, keeping(25))), 0.02 * kEdge);
}

// The step for so much noise would move this surface, which has none, by twice the noise.
TEST(KeepEdges, AFirstStepThatRemovesDetailIsMadeAgainShorter) {
    TriangleMesh bumps = shapes::geodesic_sphere(16);
    for (Eigen::Vector3d& p : bumps.positions) p *= 1 + 0.06 * (16 * p).array().sin().prod();
    FlowParameters p;
    p.keep_edges = 25;
    p.order = 2;
    p.iterations = 1;
    const FlowReport report = evolve(bumps, p);
    EXPECT_GT(report.noise, 0.02 * report.detail_size);
    EXPECT_LT(report.rms_displacement, 1.3 * report.noise);
}

// With 170 degrees, an edge of 90 is 0.7 detail sizes far to cross.
TEST(KeepEdges, ALargeAngleKeepsLittle) {
    const TriangleMesh cube = shapes::box(kQuads, {1, 1, 1});
    FlowParameters p = keeping(0);
    p.depth = 5;
    const TriangleMesh plain = evolved(cube, p);
    p = keeping(170);
    p.depth = 5;
    const TriangleMesh rounded = evolved(cube, p);
    EXPECT_GT(rms_to_cube(rounded), 0.5 * rms_to_cube(plain));
    p.keep_edges = 25;
    EXPECT_LT(rms_to_cube(evolved(cube, p)), 0.25 * rms_to_cube(rounded));
}

TEST(KeepEdges, TheResultHasTheSameBitsForAnyNumberOfThreads) {
    const TriangleMesh mesh = noisy(shapes::bumpy_sphere(40), 0.005);
    FlowParameters p;
    p.keep_edges = 25;
    p.threads = 1;
    const TriangleMesh one = evolved(mesh, p);
    for (const int threads : {2, 3}) {
        p.threads = threads;
        EXPECT_TRUE(same_bits(evolved(mesh, p), one)) << threads;
    }
}

TEST(KeepEdges, TheOrientationOfFacesDoesNotMatter) {
    const TriangleMesh mesh = noisy(shapes::box(12, {1, 1, 1}), 0.01);
    TriangleMesh flipped = mesh;
    for (std::size_t i = 1; i < mesh.triangles.size(); i += 2) {
        std::swap(flipped.triangles[i][1], flipped.triangles[i][2]);
    }
    const FlowParameters p = keeping(25);
    EXPECT_LT(distance(evolved(mesh, p), evolved(flipped, p)), 1e-4);
}

TEST(KeepEdges, PreservesTheVolume) {
    const TriangleMesh cube = noisy(shapes::box(kQuads, {1, 1, 1}), 0.2 * kEdge);
    FlowParameters p = keeping(25);
    p.preserve = Preserve::Volume;
    const TriangleMesh after = evolved(cube, p);
    EXPECT_NEAR(enclosed_volume(after), enclosed_volume(cube), 1e-6);
    EXPECT_LT(rms_to_cube(after), 0.5 * rms_to_cube(cube));
}

TEST(KeepEdges, MeanCurvatureIsThatOfTheResult) {
    const TriangleMesh sphere = shapes::geodesic_sphere(24);
    FlowParameters p;
    p.keep_edges = 10;
    p.detail_size = 0.4;  // so that the result is smooth
    p.quality = Quality::MeanCurvature;
    TriangleMesh after = sphere;
    const FlowReport report = evolve(after, p);
    const double radius = after.positions[0].norm();
    for (const double curvature : report.quality) EXPECT_NEAR(curvature, 1 / radius, 0.05);
}

TEST(KeepEdges, HoldsARimAndWhatIsNotSelected) {
    const TriangleMesh cap = noisy(bumpy_cap(16), 0.005);
    const Selection selection = above(cap, 0.5);
    FlowParameters p;
    p.keep_edges = 25;
    TriangleMesh after = cap;
    evolve(after, selection, p);
    int moved = 0;
    for (std::size_t i = 0; i < cap.triangles.size(); ++i) {
        for (const std::int32_t vertex : cap.triangles[i]) {
            const bool same = same_bits(after.positions[vertex], cap.positions[vertex]);
            EXPECT_TRUE(same || selection[i] != 0);
            moved += same ? 0 : 1;
        }
    }
    EXPECT_GT(moved, 50);
}

TEST(KeepEdges, ReportsWhatItKeeps) {
    TriangleMesh cube = shapes::box(kQuads, {1, 1, 1});
    const FlowParameters p = keeping(60);
    const FlowReport report = evolve(cube, p);
    EXPECT_NEAR(report.detail_size, p.detail_size, 1e-9);
    EXPECT_NEAR(report.normal_length, p.detail_size, 1e-6);  // twice the sine of 30° is 1
    EXPECT_GT(report.edge_share, 0.01);
    EXPECT_LT(report.edge_share, 0.5);
    EXPECT_LT(report.noise, 0.01 * kEdge);
    TriangleMesh rough = noisy(shapes::box(kQuads, {1, 1, 1}), 0.2 * kEdge);
    EXPECT_GT(evolve(rough, p).noise, 0.1 * kEdge);
}

TEST(KeepEdges, AnyAngleMakesAStep) {
    for (const double angle : {1e-300, 1e-30, 1e-3, 90.0}) {
        const TriangleMesh cube = noisy(shapes::box(kQuads, {1, 1, 1}), 0.2 * kEdge);
        TriangleMesh after = cube;
        EXPECT_EQ(evolve(after, keeping(angle)).stop, Stop::None) << angle;
        EXPECT_LT(rms_to_cube(after), rms_to_cube(cube)) << angle;
    }
}

TEST(KeepEdges, TheAreaOfAStepIsThatOfTheSurface) {
    for (const double angle : {0.01, 1.0, 25.0}) {
        TriangleMesh cube = noisy(shapes::box(kQuads, {1, 1, 1}), 0.1 * kEdge);
        FlowParameters p = keeping(angle);
        p.boundary = BoundaryCondition::Free;
        const FlowReport report = evolve(cube, p);
        EXPECT_NEAR(report.steps.front().area, report.area_before, 1e-3 * report.area_before);
    }
}

TEST(KeepEdges, AConformalizedFlowIsRefused) {
    TriangleMesh sphere = shapes::geodesic_sphere(4);
    FlowParameters p = keeping(25);
    p.flow = FlowKind::Conformalized;
    EXPECT_THROW(evolve(sphere, p), InvalidParameter);
    EXPECT_TRUE(same_bits(sphere, shapes::geodesic_sphere(4)));
}

}  // namespace
}  // namespace tracked_mcf
