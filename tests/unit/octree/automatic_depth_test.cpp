// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/automatic_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TrackedElements elements_at(const TriangleMesh& mesh, int depth) {
    return build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints);
}

TEST(AutomaticDepth, OfASoupIsThatOfItsMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    EXPECT_EQ(automatic_depth(shapes::soup(mesh)), automatic_depth(mesh));
}

TEST(AutomaticDepth, OfAStackIsThatOfItsSheet) {
    const TriangleMesh sheet = shapes::square(9);
    const TriangleMesh stack = shapes::stack(sheet, 50, 1e-6);
    EXPECT_EQ(automatic_depth(stack), automatic_depth(sheet));
    EXPECT_GT(automatic_depth(stack, false), automatic_depth(sheet));
}

TEST(AutomaticDepth, OfSeparateTrianglesDoesNotCountTheirSheets) {
    const TriangleMesh triangles = shapes::separate_triangles(5000);
    EXPECT_EQ(automatic_depth(triangles), automatic_depth(triangles, false));
}

TEST(AutomaticDepth, EndsForNeedlesAndIsOneForDegenerateTriangles) {
    TriangleMesh needles;
    TriangleMesh lines;
    for (int i = 0; i < 3000; ++i) {
        for (TriangleMesh* mesh : {&needles, &lines}) {
            const double width = mesh == &needles ? 1e-9 : 0;
            mesh->positions.insert(mesh->positions.end(),
                                   {{i * 1e-6, 0, 0}, {i * 1e-6 + width, 0, 0}, {i * 1e-6, 1, 1}});
            mesh->triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
    }
    lines.positions.back() = lines.positions.front();
    EXPECT_LE(automatic_depth(needles), kMaximumDepth);
    EXPECT_EQ(automatic_depth(lines), 1);
}

TEST(AutomaticDepth, IsTheNearestInUnknowns) {
    for (const TriangleMesh& mesh :
         {shapes::geodesic_sphere(8), shapes::bumpy_sphere(25), shapes::torus(90, 40, 1, 0.3),
          shapes::square(60), shapes::box(1, {1, 1, 1})}) {
        const auto distance = [&](int depth) {
            return std::abs(elements_at(mesh, depth).finest().unknown_count() -
                            static_cast<std::int64_t>(mesh.positions.size()));
        };
        const int depth = automatic_depth(mesh);
        ASSERT_GE(depth, 1);
        if (depth > 1) {
            EXPECT_LE(distance(depth), distance(depth - 1));
        }
        EXPECT_LE(distance(depth), distance(depth + 1));
    }
}

/// Returns how many cells of a depth are as wide as the detail size.
double cells_per_detail(const TriangleMesh& mesh, double detail_size, int depth) {
    return detail_size / enclosing_grid(mesh, depth).cell_size;
}

TEST(ResolvingDepth, IsTheLeastWithTwoCellsPerDetailThatIsFinerThanTheDefault) {
    const TriangleMesh mesh = shapes::geodesic_sphere(8);
    FlowParameters p;
    for (const double edges : {2.4, 1.0, 0.3, 0.05}) {
        p.detail_size = edges * mean_edge_length(mesh);
        const int depth = resolving_depth(mesh, enclosing_grid(mesh, 0), p);
        EXPECT_EQ(resolving_depth(mesh, enclosing_grid(mesh, 5), p), depth);
        EXPECT_GE(cells_per_detail(mesh, p.detail_size, depth), 2) << edges;
        EXPECT_LT(cells_per_detail(mesh, p.detail_size, depth - 1), 2) << edges;
    }
    p.detail_size = 1e-9;
    EXPECT_EQ(resolving_depth(mesh, enclosing_grid(mesh, 0), p), kMaximumDepth);
    p.step_size = 1;
    EXPECT_EQ(resolving_depth(mesh, enclosing_grid(mesh, 0), p), 0);
}

TEST(ResolvingDepth, TakesCellsAboutAsWideAsTheDefaultDetailAndGreaterDetail) {
    const TriangleMesh mesh = shapes::geodesic_sphere(8);
    FlowParameters p;
    const double by_default = kDefaultDetailInEdges * mean_edge_length(mesh);
    for (const double detail_size : {0.995 * by_default, 0.0, 1.5 * by_default}) {
        p.detail_size = detail_size;
        const int depth = resolving_depth(mesh, enclosing_grid(mesh, 0), p);
        const double asked = detail_size > 0 ? detail_size : by_default;
        EXPECT_GE(cells_per_detail(mesh, asked, depth), 0.9) << detail_size;
        EXPECT_LT(cells_per_detail(mesh, asked, depth - 1), 0.9) << detail_size;
    }
}

TEST(AutomaticDepth, IsUpToTwoGreaterForFineDetail) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const int balanced = automatic_depth(mesh);
    for (const int more : {-1, 0, 1, 2}) {
        EXPECT_EQ(automatic_depth(mesh, true, balanced + more), balanced + std::max(0, more));
    }
    EXPECT_EQ(automatic_depth(mesh, true, balanced + 3), balanced + 2);
}

TEST(AutomaticDepth, IsNotGreaterThanWhatFits) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const int balanced = automatic_depth(mesh);
    const Grid cube = enclosing_grid(mesh, 0);
    const auto depth_with = [&](std::int64_t available) {
        const MemoryCheck memory(size_of(Domain(mesh, BoundaryCondition::Free)), cube, {},
                                 available);
        const auto vertices = static_cast<std::int64_t>(mesh.positions.size());
        return clip_at_automatic_depth(mesh, cube, vertices, balanced + 2, memory).grid.depth;
    };
    const MemoryCheck unlimited(size_of(Domain(mesh, BoundaryCondition::Free)), cube, {}, 0);
    const auto bytes = static_cast<std::int64_t>(unlimited.flow_bytes(balanced + 1));
    EXPECT_EQ(depth_with(bytes + 1), balanced + 1);
    EXPECT_EQ(depth_with(bytes - 1), balanced);
}

TEST(AutomaticDepth, RemovesNearlyAsMuchNoiseAsTwoDepthsMore) {
    TriangleMesh mesh = shapes::geodesic_sphere(10);
    const double edge = mean_edge_length(mesh);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-0.2, 0.2);
    for (Eigen::Vector3d& position : mesh.positions) position *= 1 + noise(random) * edge;
    for (const int order : {1, 2}) {
        FlowParameters p;
        p.order = order;
        p.detail_size = 1.5 * edge;
        TriangleMesh automatic = mesh, finer = mesh;
        const FlowReport report = evolve(automatic, p);
        EXPECT_GE(report.depth, report.resolving_depth);
        p.depth = report.depth + 2;
        EXPECT_GT(report.rms_displacement, 0.85 * evolve(finer, p).rms_displacement);
    }
}

TEST(AutomaticDepth, IsThatOfTheVerticesForTheDefaultDetailAndForAStepSize) {
    for (const TriangleMesh& mesh : {shapes::geodesic_sphere(8), shapes::bumpy_sphere(20)}) {
        TriangleMesh after = mesh;
        FlowParameters p;
        EXPECT_EQ(evolve(after, p).depth, automatic_depth(mesh));
        p.detail_size = kDefaultDetailInEdges * mean_edge_length(mesh);
        EXPECT_EQ(evolve(after = mesh, p).depth, automatic_depth(mesh));
        p.detail_size = 1e-3;
        p.step_size = 1e-6;
        EXPECT_EQ(evolve(after = mesh, p).depth, automatic_depth(mesh));
    }
}

}  // namespace
}  // namespace tracked_mcf
