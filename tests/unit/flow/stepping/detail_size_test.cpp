// SPDX-License-Identifier: GPL-3.0-or-later
// The detail size is the length of the waves whose amplitude the whole flow halves.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

const double kTwoPi = 2 * std::acos(-1.0);

/// Returns the part of the amplitude of waves of length λ that the steps keep.
double kept(double wave_length, double step_size, int iterations, int order) {
    const double k = kTwoPi / wave_length;
    const double h = step_size * k * k / (1 + step_size * k * k);
    return std::pow(1 - std::pow(h, order), iterations);
}

TEST(DetailSize, WavesOfThatLengthKeepHalfTheirAmplitude) {
    for (const int iterations : {1, 2, 3, 10, 1000, kMaximumIterations}) {
        for (int order = 1; order <= kMaximumOrder; ++order) {
            for (const double detail_size : {1e-9, 0.3, 1e12}) {
                const double step_size = step_size_for(detail_size, iterations, order);
                // The power multiplies the rounding of its base by the number of steps.
                EXPECT_NEAR(kept(detail_size, step_size, iterations, order), 0.5,
                            1e-15 * (10 + iterations));
                EXPECT_NEAR(detail_size_for(step_size, iterations, order), detail_size,
                            1e-14 * detail_size);
            }
        }
    }
}

TEST(DetailSize, OfOneStepOfOrderOneIsTheScaleOfEquation2) {
    // h = 1/2 where δ k² = 1.
    for (const double detail_size : {0.1, 1.0, 7.0}) {
        const double expected = std::pow(detail_size / kTwoPi, 2);
        EXPECT_NEAR(step_size_for(detail_size, 1, 1), expected, 1e-15 * expected);
    }
}

TEST(DetailSize, ManySmallStepsApproachTheHeatEquation) {
    // Without a step's own error, amplitudes decay as exp(-k² t), and the steps' sizes add up.
    const double time = std::log(2.0) / (kTwoPi * kTwoPi);
    EXPECT_NEAR(1e6 * step_size_for(1, 1000000, 1), time, 1e-6 * time);
}

TEST(DetailSize, IsByDefaultThatOfTheMeanEdge) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    const double expected = kDefaultDetailInEdges * mean_edge_length(mesh);
    EXPECT_EQ(default_detail_size(mesh), expected);
    FlowParameters p;
    TriangleMesh after = mesh;
    const FlowReport report = evolve(after, p);
    EXPECT_NEAR(report.detail_size, expected, 1e-14 * expected);
    p.detail_size = expected;
    EXPECT_LT(distance(evolved(mesh, p), after), 1e-12);
    p.detail_size *= 2;
    EXPECT_GT(distance(evolved(mesh, p), after), 1e-3);
}

TEST(DetailSize, IsByDefaultThatOfTheSelectedEdges) {
    // The second box has edges a tenth as long.
    const TriangleMesh mesh =
        shapes::merged(shapes::box(2, {1, 1, 1}),
                       shapes::transformed(shapes::box(2, {0.1, 0.1, 0.1}),
                                           Eigen::Affine3d(Eigen::Translation3d(2, 0, 0))));
    Selection second(mesh.triangles.size(), 0);
    std::fill(second.begin() + static_cast<std::ptrdiff_t>(second.size() / 2), second.end(), 1);
    const double expected = 0.1 * default_detail_size(shapes::box(2, {1, 1, 1}));
    EXPECT_NEAR(default_detail_size(mesh, second), expected, 1e-14);
    TriangleMesh after = mesh;
    EXPECT_NEAR(evolve(after, second, FlowParameters()).detail_size, expected, 1e-14);
}

TEST(DetailSize, GivesWayToAStepSize) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    FlowParameters p = parameters(4, 1e-3, 2);
    const TriangleMesh expected = evolved(mesh, p);
    p.detail_size = 100;
    TriangleMesh after = mesh;
    const FlowReport report = evolve(after, p);
    EXPECT_TRUE(same_bits(after, expected));
    EXPECT_EQ(report.step_size, p.step_size);
    EXPECT_NEAR(report.detail_size, detail_size_for(p.step_size, 2, 1), 1e-13);
}

TEST(DetailSize, IsReportedAsThatOfTheStepThatWasMade) {
    // A step has at most 5e4 squared edges.
    FlowParameters p;
    p.depth = 3;
    p.detail_size = 1e9;
    p.order = 1;
    p.boundary = BoundaryCondition::Locked;
    TriangleMesh mesh = bumpy_cap(10);
    const FlowReport report = evolve(mesh, p);
    EXPECT_NEAR(report.step_size, 5e4 * std::pow(report.mean_edge, 2), 1e-9 * report.step_size);
    EXPECT_GT(report.asked_step_size, report.step_size);
    EXPECT_NEAR(report.detail_size, detail_size_for(report.step_size, 3, 1),
                1e-12 * report.detail_size);
}

}  // namespace
}  // namespace tracked_mcf
