// SPDX-License-Identifier: GPL-3.0-or-later
// No step takes the surface where it cannot be: outside the box that it was in.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Returns how far the flow takes a vertex out of the initial box, in diagonals of the box.
double outside(const TriangleMesh& mesh, const FlowParameters& p) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    double farthest = 0;
    for (const Eigen::Vector3d& position : evolved(mesh, p).positions) {
        farthest = std::max(farthest, box.exteriorDistance(position));
    }
    return farthest / box.diagonal().norm();
}

TriangleMesh scaled(const TriangleMesh& mesh, double x, double y, double z) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::Scaling(x, y, z)));
}

TEST(Bounds, HoldAtTheLargestSteps) {
    FlowParameters p = parameters(5, 1e9, 6);
    EXPECT_LE(outside(shapes::bumpy_sphere(12), p), 0.01);
    p.method = Method::Paper;
    EXPECT_LE(outside(shapes::bumpy_sphere(12), p), 0.01);
    EXPECT_LE(outside(shapes::torus(40, 20, 1, 0.4), p), 0.01);
    p.method = Method::Converged;
    p.flow = FlowKind::Conformalized;
    EXPECT_LE(outside(shapes::torus(40, 20, 1, 0.4), p), 0.01);
    p.order = 4;
    EXPECT_LE(outside(shapes::torus(40, 20, 1, 0.4), p), 0.11);
}

TEST(Bounds, ANeedleLosesArea) {
    const TriangleMesh mesh = scaled(shapes::geodesic_sphere(9), 1, 1, 1e6);
    for (const double step_size : {1e-5, 1e-4, 1e-3}) {
        TriangleMesh flowing = mesh;
        const FlowReport report = evolve(flowing, parameters(6, step_size, 1));
        EXPECT_LE(report.area_after, report.area_before) << step_size;
        EXPECT_TRUE(report.steps.front().reached_tolerance);
    }
}

TEST(Bounds, AComponentThatWouldBlowUpDoesNotEndTheFlowOfOthers) {
    // A strip without the force of a boundary shrinks to a line, whose area cannot be restored.
    const TriangleMesh sphere = shapes::geodesic_sphere(10);
    const TriangleMesh strip = shapes::transformed(scaled(shapes::square(8), 1, 0.02, 1),
                                                   Eigen::Affine3d(Eigen::Translation3d(2, 0, 0)));
    FlowParameters p = parameters(6, 1e-2, 20);
    p.boundary = BoundaryCondition::Free;
    p.preserve = Preserve::Area;
    TriangleMesh both = shapes::merged(sphere, strip);
    const FlowReport report = evolve(both, p);
    EXPECT_EQ(report.stop, Stop::None);
    const TriangleMesh alone = {
        {both.positions.begin(),
         both.positions.begin() + static_cast<std::ptrdiff_t>(sphere.positions.size())},
        sphere.triangles};
    EXPECT_NEAR(surface_area(alone), surface_area(sphere), 1e-6 * surface_area(sphere));
    // The strip stays in a cube of four times its length.
    for (std::size_t i = sphere.positions.size(); i < both.positions.size(); ++i) {
        EXPECT_LE((both.positions[i] - Eigen::Vector3d(2.5, 0.01, 0)).cwiseAbs().maxCoeff(), 2);
    }
}

}  // namespace
}  // namespace tracked_mcf
