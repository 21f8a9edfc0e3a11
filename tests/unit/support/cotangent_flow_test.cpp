// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/cotangent_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {
namespace {

using Eigen::Vector3d;

constexpr auto kFree = BoundaryCondition::Free;
constexpr auto kLocked = BoundaryCondition::Locked;

TriangleMesh flowed(const TriangleMesh& mesh, double step_size, int steps,
                    BoundaryCondition boundary) {
    CotangentFlow flow(mesh, step_size, boundary);
    for (int i = 0; i < steps; ++i) flow.step();
    EXPECT_LT(flow.relative_residual(), 1e-10);
    return flow.mesh();
}

/// Returns the error of the mean radius after ten steps of r(t + δ) = r³ / (r² + 2δ).
double sphere_error(int frequency) {
    constexpr double step_size = 0.01;
    const TriangleMesh mesh =
        flowed(shapes::geodesic_sphere(frequency), step_size / 4, 10, kFree);  // longest side 2
    double exact = 1;
    for (int i = 0; i < 10; ++i) exact = exact * exact * exact / (exact * exact + 2 * step_size);
    double sum = 0;
    for (const Vector3d& position : mesh.positions) sum += position.norm();
    return std::abs(sum / static_cast<double>(mesh.positions.size()) - exact);
}

TEST(CotangentFlow, RadiusOfTheSphereConvergesWithSecondOrder) {
    const double coarse = sphere_error(8);
    const double fine = sphere_error(16);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_NEAR(coarse / fine, 4, 0.4);
}

TEST(CotangentFlow, LockedPlaneStays) {
    const TriangleMesh plane = shapes::square(8);
    EXPECT_LT(worst_distance(flowed(plane, 0.1, 3, kLocked), plane), 1e-14);
}

TEST(CotangentFlow, FreePlaneShrinksInItsPlane) {
    const TriangleMesh plane = flowed(shapes::square(8), 0.1, 3, kFree);
    for (const Vector3d& position : plane.positions) EXPECT_NEAR(position[2], 0, 1e-15);
    EXPECT_LT(surface_area(plane), 0.9);
}

TEST(CotangentFlow, LockedBoundaryFixesOnlyItsVertices) {
    TriangleMesh bump = shapes::square(8);
    for (Vector3d& p : bump.positions) p[2] = p[0] * (1 - p[0]) * p[1] * (1 - p[1]);
    const TriangleMesh moved = flowed(bump, 0.01, 1, kLocked);
    for (std::size_t i = 0; i < bump.positions.size(); ++i) {
        const Vector3d& p = bump.positions[i];
        const bool on_boundary = p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
        EXPECT_EQ(moved.positions[i] == p, on_boundary) << p.transpose();
    }
}

TEST(CotangentFlow, CommutesWithTranslationAndScaling) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    const Eigen::Affine3d map = Eigen::Translation3d(3, -2, 1) * Eigen::Scaling(5.0);
    EXPECT_LT(worst_distance(flowed(shapes::transformed(mesh, map), 1e-3, 3, kFree),
                             shapes::transformed(flowed(mesh, 1e-3, 3, kFree), map)),
              1e-12);
}

TEST(CotangentFlow, SoupFlowsAsItsWeldedMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(6);
    EXPECT_LT(worst_distance(flowed(shapes::soup(mesh), 1e-3, 3, kLocked),
                             shapes::soup(flowed(mesh, 1e-3, 3, kLocked))),
              1e-13);
}

TEST(CotangentFlow, VerticesOfDegenerateTrianglesFollowTheSurface) {
    const TriangleMesh mesh = shapes::bumpy_sphere(6);
    TriangleMesh with_more = mesh;
    const auto last = static_cast<std::int32_t>(mesh.positions.size());
    const Triangle& t = mesh.triangles.front();
    with_more.triangles.push_back({t[0], t[1], t[1]});
    // A vertex in the middle of an edge, used only by a triangle of zero area, stays in the middle.
    with_more.positions.emplace_back(0.5 * (mesh.positions[t[0]] + mesh.positions[t[1]]));
    with_more.triangles.push_back({t[0], t[1], last});
    TriangleMesh moved = flowed(with_more, 1e-3, 2, kFree);
    const Vector3d middle = 0.5 * (moved.positions[t[0]] + moved.positions[t[1]]);
    EXPECT_LT((moved.positions.back() - middle).norm(), 1e-7);
    moved.positions.pop_back();
    EXPECT_LT(worst_distance(moved, flowed(mesh, 1e-3, 2, kFree)), 1e-7);
}

TEST(CotangentFlow, ReportsDegeneratedTriangles) {
    CotangentFlow sphere(shapes::geodesic_sphere(8), 1e-3, kFree);
    sphere.step();
    EXPECT_GT(sphere.smallest_quality(), 0.5);
    EXPECT_EQ(sphere.degenerated(), std::vector<std::uint8_t>(sphere.mesh().triangles.size()));
    // A thin tube shrinks to a thread: its triangles keep their length and lose their width.
    CotangentFlow tube(shapes::torus(40, 8, 1, 0.02), 1e-4, kFree);
    for (int i = 0; i < 10; ++i) tube.step();
    EXPECT_LT(tube.smallest_quality(), 0.01);
    EXPECT_EQ(tube.degenerated(), std::vector<std::uint8_t>(tube.mesh().triangles.size(), 1));
}

TEST(CotangentFlow, StaysBoundedAfterTheSurfaceHasCollapsed) {
    CotangentFlow flow(shapes::torus(40, 8, 1, 0.02), 1e-3, kFree);
    for (int i = 0; i < 60; ++i) flow.step();
    for (const Vector3d& position : flow.mesh().positions) {
        EXPECT_LT(position.cwiseAbs().maxCoeff(), 1.02);  // the initial torus lies within 1.02
    }
}

}  // namespace
}  // namespace tracked_mcf
