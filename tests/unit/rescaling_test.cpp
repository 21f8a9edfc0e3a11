#include "filter_tracked_mcf/core/rescaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/grid.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

FlowParameters keeping(Rescaling rescale, double step_size = 1e-3, int iterations = 5) {
    FlowParameters p = parameters(5, step_size, iterations);
    p.rescale = rescale;
    return p;
}

/// What evolve says; empty if it does not throw. The mesh must not have been touched.
template <class Error>
std::string complaint(const TriangleMesh& mesh, const FlowParameters& p,
                      const Selection& selection = {}) {
    TriangleMesh after = mesh;
    try {
        evolve(after, selection, p);
    } catch (const Error& error) {
        EXPECT_TRUE(same_bits(after, mesh));
        return error.what();
    }
    return {};
}

TEST(Measures, AreExactOnBoxes) {
    const Eigen::Affine3d far(Eigen::Translation3d(1e6, -2e6, 3e6));
    const TriangleMesh box = shapes::transformed(shapes::box(3, {1, 2, 3}), far);
    EXPECT_NEAR(enclosed_volume(box), 6, 1e-8);
    EXPECT_NEAR(surface_area(box), 22, 1e-7);
    EXPECT_NEAR((surface_centroid(box) - far * Eigen::Vector3d(0.5, 1, 1.5)).norm(), 0, 1e-8);
    TriangleMesh inside_out = box;
    for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
    EXPECT_NEAR(enclosed_volume(inside_out), -6, 1e-8);
}

TEST(Rescaling, KeepsVolumeOrAreaOverFiftySteps) {
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        const TriangleMesh mesh = shapes::bumpy_sphere(20);
        FlowParameters p = keeping(Rescaling::KeepVolume, 1e-3, 50);
        p.flow = flow;
        const double volume = enclosed_volume(mesh);
        EXPECT_NEAR(enclosed_volume(evolved(mesh, p)), volume, 1e-10 * volume);
        p.rescale = Rescaling::KeepArea;
        const double area = surface_area(mesh);
        EXPECT_NEAR(surface_area(evolved(mesh, p)), area, 1e-10 * area);
    }
}

TEST(Rescaling, SphereStaysWhereAndWhatItIs) {
    const Eigen::Affine3d shift(Eigen::Translation3d(5, -7, 11));
    const TriangleMesh sphere = shapes::transformed(shapes::geodesic_sphere(20), shift);
    for (const Rescaling rescale : {Rescaling::KeepVolume, Rescaling::KeepArea}) {
        EXPECT_LT(distance(evolved(sphere, keeping(rescale, 1e-2, 50)), sphere), 2e-3);
    }
}

TEST(Rescaling, OneStepIsThatOfTheFlowAndAScaling) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const TriangleMesh plain = evolved(mesh, parameters(5, 1e-3, 1));
    const double factor = std::cbrt(enclosed_volume(mesh) / enclosed_volume(plain));
    const Eigen::Vector3d centre = surface_centroid(plain);
    TriangleMesh scaled = plain;
    for (auto& p : scaled.positions) p = centre + factor * (p - centre);
    EXPECT_LT(distance(evolved(mesh, keeping(Rescaling::KeepVolume, 1e-3, 1)), scaled), 1e-12);
}

TEST(Rescaling, TurningASurfaceInsideOutChangesNothing) {
    const TriangleMesh mesh = shapes::bumpy_sphere(15);
    TriangleMesh inside_out = mesh;
    for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
    const FlowParameters p = keeping(Rescaling::KeepVolume);
    EXPECT_LT(distance(evolved(inside_out, p), evolved(mesh, p)), 1e-5);
    EXPECT_GT(distance(evolved(mesh, p), mesh), 1e-3);
}

TEST(Rescaling, FreeOpenSurfacesKeepTheirArea) {
    const TriangleMesh cap = bumpy_cap(20);
    FlowParameters p = keeping(Rescaling::KeepArea);
    p.boundary = BoundaryCondition::Free;
    const double area = surface_area(cap);
    EXPECT_NEAR(surface_area(evolved(cap, p)), area, 1e-10 * area);
}

TEST(Rescaling, WhatIsHeldCannotBeScaled) {
    const TriangleMesh cap = bumpy_cap(10);
    EXPECT_NE(complaint<InvalidParameter>(cap, keeping(Rescaling::KeepArea)).find("held"),
              std::string::npos);
    const TriangleMesh sphere = shapes::bumpy_sphere(10);
    EXPECT_NE(complaint<InvalidParameter>(sphere, keeping(Rescaling::KeepVolume), above(sphere, 0))
                  .find("unselected"),
              std::string::npos);
}

TEST(Rescaling, VolumesThatDoNotExistAreErrors) {
    FlowParameters p = keeping(Rescaling::KeepVolume);
    p.boundary = BoundaryCondition::Free;
    EXPECT_NE(complaint<InvalidMesh>(bumpy_cap(10), p).find("open"), std::string::npos);

    TriangleMesh inconsistent = shapes::bumpy_sphere(10);
    std::swap(inconsistent.triangles[7][0], inconsistent.triangles[7][1]);
    EXPECT_NE(complaint<InvalidMesh>(inconsistent, p).find("oriented"), std::string::npos);

    const TriangleMesh flat = shapes::transformed(shapes::bumpy_sphere(10),
                                                  Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 0.0)));
    EXPECT_NE(complaint<InvalidMesh>(flat, p).find("encloses none"), std::string::npos);
}

TEST(Rescaling, EndsBeforeThreadsAreBlownUp) {
    // Two balls on a bar, which pinches to a thread that stays while the balls shrink.
    TriangleMesh dumbbell = shapes::geodesic_sphere(30);
    for (auto& p : dumbbell.positions) {
        const double waist = 0.1 + 0.9 * p[0] * p[0];
        p = Eigen::Vector3d(2 * p[0], waist * p[1], waist * p[2]);
    }
    for (const Rescaling rescale : {Rescaling::KeepVolume, Rescaling::KeepArea}) {
        TriangleMesh after = dumbbell;
        const FlowReport report = evolve(after, keeping(rescale, 5e-3, 100));
        EXPECT_EQ(report.stop, Stop::Pinched);
        EXPECT_GT(report.steps.size(), 2U);
        EXPECT_LE(longest_side(after), 4 * longest_side(dumbbell));
    }
}

TEST(Rescaling, VolumesThatCancelDoNotBlowTheMeshUp) {
    TriangleMesh inside_out = shapes::geodesic_sphere(10);
    for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
    const Eigen::Affine3d beside =
        Eigen::Affine3d(Eigen::Translation3d(3, 0, 0)) * Eigen::Scaling(0.9);
    const TriangleMesh both =
        shapes::merged(shapes::geodesic_sphere(10), shapes::transformed(inside_out, beside));
    TriangleMesh after = both;
    EXPECT_NE(evolve(after, keeping(Rescaling::KeepVolume, 5e-3, 50)).stop, Stop::None);
    EXPECT_LE(longest_side(after), 4 * longest_side(both));
}

TEST(Rescaling, BodiesThatTouchInAnEdgeHaveAVolume) {
    // Two boxes with a common edge, welded: four triangles have it, two in either direction.
    const TriangleMesh two =
        shapes::merged(shapes::box(2, {1, 1, 1}),
                       shapes::transformed(shapes::box(2, {1, 1, 1}),
                                           Eigen::Affine3d(Eigen::Translation3d(1, 1, 0))));
    const FlowParameters p = keeping(Rescaling::KeepVolume, 1e-4, 2);
    EXPECT_NEAR(enclosed_volume(evolved(two, p)), 2, 1e-10);
}

}  // namespace
}  // namespace tracked_mcf
