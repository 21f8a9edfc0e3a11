// SPDX-License-Identifier: GPL-3.0-or-later
// A flow stops when nothing can move any more.

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(Stop, UndoesTheStepInWhichASphereVanishes) {
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        for (const Method method : {Method::Converged, Method::Paper}) {
            if (method == Method::Paper && flow == FlowKind::Conformalized) continue;
            const TriangleMesh sphere = shapes::bumpy_sphere(20);
            TriangleMesh mesh = sphere;
            FlowParameters p = parameters(5, 1e-2, 200);
            p.flow = flow;
            p.method = method;
            const FlowReport report = evolve(mesh, p);
            EXPECT_EQ(report.stop, Stop::Vanished);
            ASSERT_FALSE(report.steps.empty());
            EXPECT_LT(report.steps.size(), 30U);
            EXPECT_GT(report.area_after, kVanishedArea * report.area_before);
            // A flow of just the reported steps gives the same mesh: the vanishing step was undone.
            TriangleMesh until_then = sphere;
            p.iterations = static_cast<int>(report.steps.size());
            const FlowReport of_just_these = evolve(until_then, p);
            EXPECT_EQ(of_just_these.stop, Stop::None);
            EXPECT_EQ(of_just_these.detail_size, report.detail_size);
            EXPECT_TRUE(same_bits(mesh, until_then));
            // The vanishing step is undone also if it is the last step.
            TriangleMesh just = sphere;
            ++p.iterations;
            EXPECT_EQ(evolve(just, p).stop, Stop::Vanished);
            EXPECT_TRUE(same_bits(mesh, just));
        }
    }
}

TEST(Stop, UndoesAFirstStepInWhichTheSurfaceVanishes) {
    const TriangleMesh sphere = shapes::geodesic_sphere(10);
    for (const Preserve preserve : {Preserve::None, Preserve::Volume, Preserve::Area}) {
        TriangleMesh mesh = sphere;
        FlowParameters p = parameters(4, 1e3, 3);
        p.preserve = preserve;
        const FlowReport report = evolve(mesh, p);
        EXPECT_EQ(report.stop, Stop::Vanished);
        EXPECT_TRUE(report.steps.empty());
        EXPECT_EQ(report.detail_size, 0);
        EXPECT_EQ(report.area_after, report.area_before);
        EXPECT_TRUE(same_bits(mesh, sphere));
    }
}

TEST(Stop, NothingMovesIfAllUnknownsAreConstrained) {
    const TriangleMesh square = shapes::square(10);
    TriangleMesh mesh = square;
    FlowParameters p = parameters(1, 1e-2, 5);
    p.method = Method::Paper;
    const FlowReport report = evolve(mesh, p);
    EXPECT_EQ(report.stop, Stop::NothingMoves);
    EXPECT_EQ(report.constrained_unknowns, report.unknowns);
    EXPECT_TRUE(report.steps.empty());
    EXPECT_TRUE(same_bits(mesh, square));
}

TEST(Stop, NothingMovesIfAllVerticesAreConstrained) {
    const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    TriangleMesh mesh = triangle;
    EXPECT_EQ(evolve(mesh, parameters(4, 1e-2, 5)).stop, Stop::NothingMoves);
    EXPECT_TRUE(same_bits(mesh, triangle));
}

TEST(Stop, FlowsWithFreeVerticesMakeAllSteps) {
    TriangleMesh mesh = bumpy_cap(15);
    const FlowReport report = evolve(mesh, parameters(5, 1, 30));
    EXPECT_EQ(report.stop, Stop::None);
    EXPECT_EQ(report.steps.size(), 30U);
}

}  // namespace
}  // namespace tracked_mcf
