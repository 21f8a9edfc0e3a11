// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/flow/stepping/mesh_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

// A flow has references to its own members.
static_assert(!std::is_copy_constructible_v<MeshFlow> && !std::is_move_constructible_v<MeshFlow>);
static_assert(!std::is_copy_constructible_v<PaperFlow> && !std::is_move_constructible_v<PaperFlow>);

TEST(Flow, FlatPatchWithLockedBoundaryStaysToTheRoundingOfSinglePrecision) {
    // In a grid plane, near one (quarter turns round), and oblique to the grid.
    const TriangleMesh square = shapes::square(30);
    for (const TriangleMesh& patch :
         {square, turned(square, kQuarterTurn, {1, 0, 0}), turned(square, kQuarterTurn, {0, 1, 0}),
          turned(square, kQuarterTurn, {0, 0, 1}), turned(square, 0.7, {1, 2, 0.5})}) {
        EXPECT_LT(distance(evolved(patch, parameters(5, 1e-3, 10)), patch), 1e-6);
    }
}

TEST(Flow, FlatPatchWithNoiseStays) {
    // The middle of the box is a grid plane. The noise makes slivers on both sides of the plane.
    // The functions of the thinnest slivers are below single precision.
    const TriangleMesh square = shapes::square(40);
    for (const double size :
         {1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
        const TriangleMesh patch = noisy(square, size);
        const TriangleMesh after = evolved(patch, parameters(5, 1e-4, 10));
        EXPECT_LT(distance(after, patch), 1e-6 + 10 * size) << size;
        EXPECT_LE(surface_area(after), surface_area(patch) * (1 + 1e-6)) << size;
    }
}

/// A sphere with one part pressed flat at half its height.
TriangleMesh sphere_with_plateau() {
    TriangleMesh mesh = shapes::geodesic_sphere(25);
    for (auto& position : mesh.positions) {
        if (position[0] > 0.1) position[2] = std::min(position[2], 0.0);
    }
    return mesh;
}

/// Returns the distance between the flows of sphere_with_plateau without and with noise: the
/// largest over all sizes of noise.
double largest_effect_of_noise(const FlowParameters& p) {
    const TriangleMesh mesh = sphere_with_plateau();
    const TriangleMesh exact = evolved(mesh, p);
    double largest = 0;
    for (const double size : {1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6}) {
        largest = std::max(largest, distance(evolved(noisy(mesh, size), p), exact));
    }
    return largest;
}

TEST(Flow, NoiseHardlyChangesTheFlowOfAPlateauInAGridPlane) {
    FlowParameters p = parameters(5, 1e-4, 10);
    p.method = Method::Paper;
    EXPECT_LT(largest_effect_of_noise(p), 2e-5);
}

TEST(Flow, LockedBoundaryVerticesKeepTheirBits) {
    TriangleMesh cap = shapes::bumpy_sphere(20);
    cap.triangles.resize(cap.triangles.size() / 2);
    const TriangleMesh after = evolved(cap, parameters(5, 1e-4, 5));
    const Surface surface = surface_of(cap);
    int checked = 0;
    for (std::int32_t i = 0; i < surface.stars.count(); ++i) {
        if (surface.stars.on_rim[i] == 0) continue;
        const std::int32_t vertex = surface.mesh_vertices[i];
        EXPECT_EQ(after.positions[vertex], cap.positions[vertex]);
        ++checked;
    }
    EXPECT_GT(checked, 40);
    EXPECT_GT(distance(after, cap), 1e-3);
}

void expect_same_bits_at_any_number_of_threads(const TriangleMesh& mesh, FlowParameters p) {
    p.threads = 1;
    const TriangleMesh one = evolved(mesh, p);
    for (const int threads : {2, 3, 5}) {
        p.threads = threads;
        EXPECT_TRUE(same_bits(evolved(mesh, p), one)) << threads;
    }
}

TEST(Flow, ResultHasTheSameBitsForAnyNumberOfThreads) {
    // Large enough for many chunks and several slabs of cells.
    const TriangleMesh mesh = shapes::bumpy_sphere(60);
    FlowParameters p = parameters(7, 1e-4, 2);
    for (const Method method : {Method::Paper, Method::Converged}) {
        p.method = method;
        expect_same_bits_at_any_number_of_threads(mesh, p);
    }
    expect_same_bits_at_any_number_of_threads(bumpy_cap(60), p);
    p.flow = FlowKind::Conformalized;
    p.preserve = Preserve::Volume;
    expect_same_bits_at_any_number_of_threads(mesh, p);
}

TEST(Flow, OfThePaperHasTheSameBitsOnTheGridOfItsPlan) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    FlowParameters p = parameters(4, 1e-4, 1);
    p.method = Method::Paper;
    PaperFlow usual(paper_plan_of(mesh, p)),
        given(paper_plan_of(mesh, p, paper_plan_of(mesh, p).clipped.grid));
    ASSERT_TRUE(usual.step());
    ASSERT_TRUE(given.step());
    EXPECT_EQ(usual.displacement(), given.displacement());
}

TEST(Flow, StopsWhenItsNumbersAreNotFinite) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    FlowParameters p = parameters(4, 1e-4, 1);
    p.step_size = std::numeric_limits<double>::quiet_NaN();  // validate() rejects it
    PaperPlan plan = paper_plan_of(mesh, p);
    plan.step_size = p.step_size;
    PaperFlow flow(std::move(plan));
    EXPECT_FALSE(flow.step());
    EXPECT_EQ(flow.report().stop, Stop::StepFailed);
    EXPECT_TRUE(flow.report().steps.empty());
    EXPECT_TRUE(flow.displacement().isZero(0));
}

TEST(Flow, LongFlowStaysFiniteAndItsAreaNeverIncreases) {
    // A thin torus pinches to a circle, a sphere to a point. The final area consists of rounding
    // errors, so increases are measured relative to the initial area.
    for (const TriangleMesh& mesh : {shapes::torus(60, 20, 1, 0.15), shapes::bumpy_sphere(12)}) {
        TriangleMesh flowing = mesh;
        const FlowReport report = evolve(flowing, parameters(5, 2e-3, 100));
        EXPECT_TRUE(report.steps.size() == 100 || report.stop == Stop::Vanished);
        for (std::size_t i = 1; i < report.steps.size(); ++i) {
            EXPECT_LE(report.steps[i].area, report.steps[i - 1].area + 1e-6 * report.area_before)
                << i;
        }
        for (const auto& position : flowing.positions) EXPECT_TRUE(position.allFinite());
        EXPECT_LT(report.area_after, 0.1 * report.area_before);
    }
}

TEST(Flow, PinchedPartsStayWhereTheyAre) {
    // A dumbbell's thin bar pinches first. Mean-curvature flow shrinks the convex hull, so no
    // vertex may leave the initial bounding box.
    TriangleMesh mesh = shapes::geodesic_sphere(40);
    for (auto& p : mesh.positions) {
        const double waist = 0.06 + 0.94 * p[0] * p[0];
        p = Eigen::Vector3d(2 * p[0], waist * p[1], waist * p[2]);
    }
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    TriangleMesh after = mesh;
    EXPECT_EQ(evolve(after, scaled_to(mesh, parameters(6, 2e-4, 60))).stop, Stop::Vanished);
    for (const auto& position : after.positions) EXPECT_TRUE(box.contains(position));
}

TEST(Flow, AcceptsNonManifoldAndMisorientedMeshes) {
    TriangleMesh mesh = shapes::bumpy_sphere(10);
    const TriangleMesh as_it_was = evolved(mesh, parameters(4, 1e-3, 2));
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    }
    EXPECT_LT(distance(evolved(mesh, parameters(4, 1e-3, 2)), as_it_was), 1e-3);
    mesh.triangles.push_back(mesh.triangles[7]);
    mesh.triangles.push_back({0, 5, 300});
    EXPECT_NO_THROW(evolve(mesh, parameters(4, 1e-3, 2)));
}

}  // namespace
}  // namespace tracked_mcf
