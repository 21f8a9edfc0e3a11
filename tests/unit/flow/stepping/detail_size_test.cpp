// SPDX-License-Identifier: GPL-3.0-or-later
// The detail size is the length of the waves whose amplitude the whole flow halves.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "filter_tracked_mcf/core/flow/cells/grid.h"
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

// Waves on a plate, in units of the detail size. The plate is oblique to the grid.

constexpr int kLength = 8;  ///< along x, in which the waves run
constexpr int kWidth = 5;   ///< along y, in which the waves do not change
constexpr int kVerticesPerUnit = 20;

/// Slopes of 2π/100 change the flow by their square, 0.4 %.
constexpr double kAmplitudeInWaves = 0.01;

Eigen::Affine3d placement() {
    return Eigen::Affine3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.5).normalized()));
}

double wave(double wave_length, const Eigen::Vector3d& position) {
    return std::sin(kTwoPi / wave_length * position[0]);
}

/// A plate [0, kLength] x [0, kWidth] with waves. Its ends in x are nodes of every wave.
TriangleMesh wavy_plate(double wave_length) {
    const int n = kLength * kVerticesPerUnit;
    const int m = kWidth * kVerticesPerUnit;
    TriangleMesh mesh;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) {
            Eigen::Vector3d position(i, j, 0);
            position /= kVerticesPerUnit;
            position[2] = kAmplitudeInWaves * wave_length * wave(wave_length, position);
            mesh.positions.push_back(position);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const int a = i * (m + 1) + j, b = a + m + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return shapes::transformed(mesh, placement());
}

/// Returns the part of the amplitude that the flow keeps in the plate's middle, by projection. The
/// middle consists of whole waves. The locked sides are 2.25 units away, and their effect decays
/// with the length √δ, which is at most 0.32 units: to exp(-7) or 1e-3.
double measured(double wave_length, const FlowParameters& p) {
    const TriangleMesh before = wavy_plate(wave_length);
    const TriangleMesh after = evolved(before, p);
    const Eigen::Affine3d back = placement().inverse();
    double product = 0, square = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const Eigen::Vector3d start = back * before.positions[i];
        if (start[0] < 2 || start[0] >= 6 || std::abs(start[1] - 2.5) > 0.25) continue;
        product += (back * after.positions[i])[2] * wave(wave_length, start);
        square += start[2] * wave(wave_length, start);
    }
    return product / square;
}

class WavyPlate : public testing::TestWithParam<std::tuple<int, int>> {
protected:
    FlowParameters parameters() const {
        FlowParameters p;
        p.detail_size = 1;
        std::tie(p.iterations, p.order) = GetParam();
        p.depth = 7;
        return p;
    }
    double expected(double wave_length) const {
        const auto [iterations, order] = GetParam();
        return kept(wave_length, step_size_for(1, iterations, order), iterations, order);
    }
};

TEST_P(WavyPlate, WavesOfTheDetailSizeKeepHalfTheirAmplitude) {
    EXPECT_NEAR(measured(1, parameters()), 0.5, 0.05 * 0.5);
}

TEST_P(WavyPlate, LongerWavesKeepMoreAndShorterOnesLess) {
    // Slopes and the solver's tolerance matter.
    EXPECT_NEAR(measured(2, parameters()), expected(2), 0.01);
    EXPECT_NEAR(measured(0.5, parameters()), expected(0.5), 0.03);
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<int, int>>& info) {
    return std::to_string(std::get<0>(info.param)) + "StepsOfOrder" +
           std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(StepsAndOrders, WavyPlate,
                         testing::Combine(testing::Values(1, 3), testing::Values(1, 2, 3)),
                         name_of_case);

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
