// SPDX-License-Identifier: GPL-3.0-or-later
// The unit sphere after steps of δ = 1e-3 against its exact semi-implicit radius (sections 5.2
// and 5.3, Figures 6 to 8).

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
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

Radius radius_after_flow(FlowParameters parameters, int steps, int frequency = 128) {
    TriangleMesh mesh = shapes::geodesic_sphere(frequency);
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
    const int steps = TRACKED_MCF_LONG_TESTS ? kSteps : 20;
    const Radius one = radius_after_flow(papers(Cubature::OnePoint), steps);
    const Radius three = radius_after_flow(papers(Cubature::ThreePoints), steps);
    const Radius degree_6 = radius_after_flow(papers(Cubature::Degree6), steps);
    print("1 point", one);
    print("3 points", three);
    print("degree 6", degree_6);
    // Three points leave the error that exact integrals leave, too; one point does not.
    EXPECT_LT(std::abs(three.mean - degree_6.mean), 0.1 * std::abs(degree_6.error));
    EXPECT_GT(std::abs(one.error), 10 * std::abs(degree_6.error));
}

TEST(Sphere, ErrorOfTheConvergedSolverFallsWithTheSquareOfTheEdge) {
    FlowParameters parameters;
    parameters.tolerance = 1e-6;
    const int steps = TRACKED_MCF_LONG_TESTS ? kSteps : 20;
    const Radius coarse = radius_after_flow(parameters, steps, 32);
    const Radius fine = radius_after_flow(parameters, steps, 64);
    print("coarse", coarse);
    print("fine", fine);
    EXPECT_NEAR(std::log2(coarse.error / fine.error), 2, 0.1);
    // At single vertices, cotangents are less accurate than on average.
    EXPECT_GT(std::log2(coarse.worst_error / fine.worst_error), 1.5);
}

/// By Cauchy's formula, the grid lines cross a convex surface twice as often as they meet its three
/// shadows: 6 π / w² times for the unit sphere and cells of side w. The surface meets a cell for
/// each of these crossings. The supports of the unknowns are the cells of eight shifted grids with
/// sides twice as long. A triangle meets one cell, and another for each grid plane and each grid
/// line that crosses it. Its polygons have a corner for each of its corners, two for each crossing
/// of a side and a plane, and four for each crossing of the triangle and a line. A polygon has two
/// fewer split triangles than corners.
TEST(Sphere, SizesAreThoseOfIntegralGeometryAndOfThePaper) {
    // Turned, so that no edges lie in planes of the grid.
    const Eigen::AngleAxisd turn(0.6, Eigen::Vector3d(1, 2, 3).normalized());
    TriangleMesh mesh = shapes::transformed(shapes::geodesic_sphere(192), Eigen::Affine3d(turn));
    double extents = 0;  // total length of the sides of the triangles' boxes
    for (const Triangle& t : mesh.triangles) {
        const auto [a, b, c] = corners_of(mesh.positions, t);
        extents += (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).sum();
    }
    FlowParameters parameters;
    parameters.step_size = kStepSize;
    parameters.iterations = 1;
    parameters.method = Method::Paper;
    const FlowReport report = evolve(mesh, parameters);
    EXPECT_EQ(report.depth, 8);  // chosen automatically
    const double crossings = 6 * std::acos(-1.0) / std::pow(report.cell_size, 2);
    const double planes = extents / report.cell_size;
    const auto triangles = static_cast<double>(report.triangles);
    // The numbers vary with the place of the grid, by less than they would if they were random.
    const auto expect = [](std::int64_t count, double expected) {
        EXPECT_NEAR(static_cast<double>(count), expected, std::sqrt(expected));
    };
    expect(report.cells, crossings);
    expect(report.unknowns, 2 * crossings);
    expect(report.fragments, triangles + planes + crossings);
    expect(report.split_triangles, triangles + 2 * planes + 2 * crossings);
    // Table 1 of the paper: 3.7e5 vertices, 3.8e6 split triangles and 5.1e5 unknowns.
    EXPECT_NEAR(static_cast<double>(report.vertices), 3.7e5, 0.05e5);
    EXPECT_NEAR(static_cast<double>(report.unknowns), 5.1e5, 0.05e5);
}

}  // namespace
}  // namespace tracked_mcf
