// A flow ends by itself when there is nothing left to do.

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(Stop, SphereIsLeftAsItWasBeforeItVanished) {
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
            const TriangleMesh sphere = shapes::bumpy_sphere(20);
            TriangleMesh mesh = sphere;
            FlowParameters p = parameters(5, 1e-2, 200);
            p.flow = flow;
            p.solver = solver;
            const FlowReport report = evolve(mesh, p);
            EXPECT_EQ(report.stop, Stop::Vanished);
            ASSERT_FALSE(report.steps.empty());
            EXPECT_LT(report.steps.size(), 30U);
            EXPECT_GT(report.area_after, kVanishedArea * report.area_before);
            // One step less gives the same: the last one was taken back.
            TriangleMesh until_then = sphere;
            p.iterations = static_cast<int>(report.steps.size());
            EXPECT_EQ(evolve(until_then, p).stop, Stop::None);
            EXPECT_TRUE(same_bits(mesh, until_then));
            // As the very last step, too, it is taken back.
            TriangleMesh just = sphere;
            ++p.iterations;
            EXPECT_EQ(evolve(just, p).stop, Stop::Vanished);
            EXPECT_TRUE(same_bits(mesh, just));
        }
    }
}

TEST(Stop, StepThatLeavesNothingLeavesTheMeshAsItWas) {
    const TriangleMesh sphere = shapes::geodesic_sphere(10);
    for (const Rescaling rescale : {Rescaling::None, Rescaling::KeepVolume, Rescaling::KeepArea}) {
        TriangleMesh mesh = sphere;
        FlowParameters p = parameters(4, 1e3, 3);
        p.rescale = rescale;
        const FlowReport report = evolve(mesh, p);
        EXPECT_EQ(report.stop, Stop::Vanished);
        EXPECT_TRUE(report.steps.empty());
        EXPECT_EQ(report.area_after, report.area_before);
        EXPECT_TRUE(same_bits(mesh, sphere));
    }
}

TEST(Stop, NothingMovesWhereTheLockHoldsEverything) {
    const TriangleMesh square = shapes::square(10);
    TriangleMesh mesh = square;
    FlowParameters p = parameters(1, 1e-2, 5);
    p.boundary = BoundaryCondition::LockedCells;
    const FlowReport report = evolve(mesh, p);
    EXPECT_EQ(report.stop, Stop::NothingMoves);
    EXPECT_TRUE(report.steps.empty());
    EXPECT_TRUE(same_bits(mesh, square));
}

TEST(Stop, NothingMovesWhereEveryVertexIsHeld) {
    const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    TriangleMesh mesh = triangle;
    EXPECT_EQ(evolve(mesh, parameters(4, 1e-2, 5)).stop, Stop::NothingMoves);
    EXPECT_TRUE(same_bits(mesh, triangle));
}

TEST(Stop, FlowsThatHaveSomethingToDoMakeAllTheirSteps) {
    TriangleMesh mesh = bumpy_cap(15);
    const FlowReport report = evolve(mesh, parameters(5, 1, 30));
    EXPECT_EQ(report.stop, Stop::None);
    EXPECT_EQ(report.steps.size(), 30U);
}

}  // namespace
}  // namespace tracked_mcf
