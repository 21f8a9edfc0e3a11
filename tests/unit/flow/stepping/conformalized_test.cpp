// SPDX-License-Identifier: GPL-3.0-or-later
// Conformalized flow: the mass of the current metric, the stiffness of the initial metric.

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/mesh_system.h"

namespace tracked_mcf {
namespace {

FlowParameters conformalized(int depth, double step_size, int iterations) {
    FlowParameters p = parameters(depth, step_size, iterations);
    p.flow = FlowKind::Conformalized;
    return p;
}

/// Returns the standard deviation of the vertices' distances from the centroid, relative to their
/// mean.
double roundness(const TriangleMesh& mesh) {
    const Eigen::Vector3d centre = shapes::surface_centroid(mesh);
    double sum = 0, squares = 0;
    for (const Eigen::Vector3d& p : mesh.positions) {
        sum += (p - centre).norm();
        squares += (p - centre).squaredNorm();
    }
    const double mean = sum / static_cast<double>(mesh.positions.size());
    const double variance = squares / static_cast<double>(mesh.positions.size()) - mean * mean;
    return std::sqrt(std::max(0.0, variance)) / mean;
}

TEST(Conformalized, TheStiffnessIsOfTheInitialMetricAndTheMassOfThePresentOne) {
    const TriangleMesh mesh = shapes::bumpy_sphere(8);
    FlowParameters p = conformalized(0, 0.005, 2);
    p.tolerance = 1e-8;
    const TriangleMesh after = evolved(mesh, p);
    p.iterations = 1;
    const Surface initial = surface_of(mesh);
    // In the units and the order of the initial surface.
    const auto positions_of = [&](const TriangleMesh& moved) {
        std::vector<Eigen::Vector3d> positions(initial.positions.size());
        for (std::size_t i = 0; i < moved.positions.size(); ++i) {
            positions[static_cast<std::size_t>(initial.vertices[i])] =
                moved.positions[i] / initial.edge;
        }
        return positions;
    };
    const std::vector<Eigen::Vector3d> x = positions_of(evolved(mesh, p));
    const double delta = p.step_size / (initial.edge * initial.edge);
    const Eigen::MatrixXd stiffness = delta * dense_stiffness(initial.stars, elements_of(initial));
    const Eigen::MatrixXd mass =
        dense_mass(initial.stars, elements_in_own_metric(initial.stars, x, {}));
    const Eigen::MatrixXd expected =
        rows_of(x) - (mass + stiffness).ldlt().solve(stiffness * rows_of(x));
    const Eigen::MatrixXd found = rows_of(positions_of(after));
    EXPECT_LT((found - expected).norm(), 1e-4 * (found - rows_of(x)).norm());
}

TEST(Conformalized, SphereShrinksToTheSemiImplicitRadius) {
    // Let M be the initial mass matrix, R the initial radius and r the current radius. Then D =
    // (r/R)² M, and S x = (2/R²) M x for the coordinates x. So ((r/R)² + 2δ/R²) r(t+δ) = (r/R)² r,
    // which gives r(t+δ) = r³ / (r² + 2δ), as in mean-curvature flow: scaling does not change S.
    const TriangleMesh sphere = shapes::geodesic_sphere(40);
    FlowParameters p = conformalized(5, 1e-2 / 4, 20);
    double radius = 1;
    for (int step = 0; step < p.iterations; ++step) {
        radius = radius * radius * radius / (radius * radius + 2 * p.step_size);
    }
    for (const Eigen::Vector3d& position : evolved(sphere, p).positions) {
        EXPECT_NEAR(position.norm(), radius, 2e-3 * radius);
    }
    EXPECT_LT(radius, 0.8);
}

TEST(Conformalized, FirstStepIsThatOfMeanCurvatureFlow) {
    const TriangleMesh mesh = shapes::bumpy_sphere(15);
    EXPECT_LT(
        distance(evolved(mesh, conformalized(5, 1e-3, 1)), evolved(mesh, parameters(5, 1e-3, 1))),
        1e-5);
    EXPECT_GT(
        distance(evolved(mesh, conformalized(5, 1e-3, 9)), evolved(mesh, parameters(5, 1e-3, 9))),
        1e-3);
}

TEST(Conformalized, DumbbellBecomesASphereWhereMeanCurvatureFlowPinches) {
    TriangleMesh dumbbell = shapes::geodesic_sphere(40);
    for (auto& p : dumbbell.positions) {
        const double waist = 0.3 + 0.7 * p[0] * p[0];
        p = Eigen::Vector3d(2 * p[0], waist * p[1], waist * p[2]);
    }
    FlowParameters p = scaled_to(dumbbell, conformalized(6, 5e-3, 200));
    p.preserve = Preserve::Area;
    TriangleMesh round = dumbbell;
    for (const StepReport& step : evolve(round, p).steps) {
        EXPECT_EQ(step.collapsed_samples, 0);
        EXPECT_TRUE(step.reached_tolerance);
    }
    // At its waist, the triangles are seven times as long as wide. 0.036; 0.014 with half the
    // edges.
    EXPECT_LT(roundness(round), 0.05);
    EXPECT_GT(roundness(dumbbell), 0.3);

    TriangleMesh pinched = dumbbell;
    evolve(pinched, scaled_to(dumbbell, parameters(6, 1e-3, 60)));
    EXPECT_GT(roundness(pinched), 0.3);
}

TEST(Conformalized, VanishedComponentsStayWhileTheOthersFlow) {
    // A sphere and small thin boxes.
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    TriangleMesh mesh = sphere;
    for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d at(2 + 0.37 * (i % 3), 0.61 * (i % 5), 0.73 * (i % 4));
        const Eigen::Affine3d place =
            Eigen::Affine3d(Eigen::Translation3d(at)) * Eigen::Scaling(0.01 + 0.004 * i);
        mesh = shapes::merged(mesh, shapes::transformed(shapes::box(3, {1, 1, 0.1}), place));
    }
    TriangleMesh after = mesh;
    const FlowReport report = evolve(after, conformalized(0, 1e-4, 20));
    EXPECT_EQ(report.steps.size(), 20U);
    for (const StepReport& step : report.steps) EXPECT_TRUE(step.reached_tolerance);
    for (std::size_t i = sphere.positions.size(); i < mesh.positions.size(); ++i) {
        EXPECT_LT((after.positions[i] - mesh.positions[i]).norm(), 0.1);
    }
    EXPECT_LT(after.positions[0].norm(), 0.999 * mesh.positions[0].norm());
}

}  // namespace
}  // namespace tracked_mcf
