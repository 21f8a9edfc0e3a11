// SPDX-License-Identifier: GPL-3.0-or-later
// The unit sphere after steps of δ = 1e-3 against its exact semi-implicit radius (sections 5.2
// and 5.3, Figures 6 to 8).

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr int kSteps = 100;  // as in the paper
constexpr double kStepSize = 1e-3;

/// r(t + δ) = r³ / (r² + 2δ)
double exact_radius(int steps) {
    double r = 1;
    for (int step = 0; step < steps; ++step) r = r * r * r / (r * r + 2 * kStepSize);
    return r;
}

struct Radius {
    double mean = 0;
    double error = 0;  ///< of the mean
    double worst_error = 0;
};

/// Returns the parameters of the paper's solver and system.
FlowParameters papers(Cubature cubature) {
    FlowParameters parameters;
    parameters.method = Method::Paper;
    parameters.cubature = cubature;
    return parameters;
}

Radius radius_after_flow(FlowParameters parameters, int steps) {
    TriangleMesh mesh = shapes::geodesic_sphere(128);
    EXPECT_EQ(mesh.positions.size(), 163842U);
    parameters.order = 1;
    parameters.depth = 7;
    parameters.step_size = kStepSize;
    parameters.iterations = steps;
    for (const StepReport& step : evolve(mesh, parameters).steps) {
        EXPECT_TRUE(step.reached_tolerance);
    }
    const double expected = exact_radius(steps);
    Radius radius;
    for (const Eigen::Vector3d& position : mesh.positions) {
        radius.mean += position.norm();
        radius.worst_error = std::max(radius.worst_error, std::abs(position.norm() - expected));
    }
    radius.mean /= static_cast<double>(mesh.positions.size());
    radius.error = radius.mean - expected;
    return radius;
}

void print(const char* name, const Radius& radius) {
    std::printf("%-9s mean radius %.6f, error %+.1e, worst vertex %.1e\n", name, radius.mean,
                radius.error, radius.worst_error);
}

TEST(Sphere, ExactRadius) {
    EXPECT_NEAR(exact_radius(kSteps), 0.775578, 5e-7);
}

TEST(Sphere, ThreePointCubatureSufficesForThePapersSolver) {
    // The error grows faster than the square of the number of steps.
    const int steps = TRACKED_MCF_LONG_TESTS ? kSteps : 20;
    const Radius one = radius_after_flow(papers(Cubature::OnePoint), steps);
    const Radius three = radius_after_flow(papers(Cubature::ThreePoints), steps);
    const Radius degree_6 = radius_after_flow(papers(Cubature::Degree6), steps);
    print("1 point", one);
    print("3 points", three);
    print("degree 6", degree_6);
    EXPECT_LT(std::abs(three.error), 2e-7 * steps * steps);
    EXPECT_NEAR(degree_6.mean, three.mean, 1e-7 * steps);
    EXPECT_GT(std::abs(one.error), 10 * std::abs(three.error));
}

TEST(Sphere, ConvergedSolverReachesTheErrorOfTheMesh) {
    const Radius radius = radius_after_flow({}, TRACKED_MCF_LONG_TESTS ? kSteps : 20);
    print("converged", radius);
    EXPECT_LT(std::abs(radius.error), 4e-6);
    EXPECT_LT(radius.worst_error, 5e-5);
}

TEST(Sphere, SizesAreThoseOfThePaper) {
    // The paper's Table 1 has 3.7e5 vertices, 3.8e6 split triangles and 5.1e5 unknowns at depth 8.
    // The last three counts depend on the sphere's orientation: expect this one's, within 1 %.
    TriangleMesh mesh = shapes::geodesic_sphere(192);
    FlowParameters parameters;
    parameters.step_size = kStepSize;
    parameters.iterations = 1;
    parameters.method = Method::Paper;
    const FlowReport report = evolve(mesh, parameters);
    EXPECT_EQ(report.vertices, 368642);
    EXPECT_EQ(report.triangles, 737280);
    EXPECT_EQ(report.depth, 8);  // chosen automatically
    EXPECT_NEAR(static_cast<double>(report.cells), 255320, 2553);
    EXPECT_NEAR(static_cast<double>(report.unknowns), 510604, 5106);
    EXPECT_NEAR(static_cast<double>(report.split_triangles), 3.66e6, 3.66e4);
}

}  // namespace
}  // namespace tracked_mcf
