// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/automatic_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <utility>

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
}

TEST(AutomaticDepth, OfSeparateTrianglesDoesNotCountTheirSheets) {
    const TriangleMesh triangles = shapes::separate_triangles(5000);
    const std::int32_t unknowns =
        build_tracked_elements(triangles, enclosing_grid(triangles, automatic_depth(triangles)),
                               Cubature::ThreePoints, false)
            .finest()
            .unknown_count();
    EXPECT_GT(unknowns, 15000 / 3);
    EXPECT_LT(unknowns, 15000 * 3);
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
    EXPECT_LE(automatic_depth(needles), 8);
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

int least_depth(const TriangleMesh& mesh, double detail_size, int depth = 0) {
    return resolving_depth(detail_size, mean_edge_length(mesh), enclosing_grid(mesh, depth));
}

TEST(ResolvingDepth, IsTheLeastWithTwoCellsPerDetailThatIsFinerThanTheDefault) {
    const TriangleMesh mesh = shapes::geodesic_sphere(8);
    for (const double edges : {2.4, 1.0, 0.3, 0.05}) {
        const double detail_size = edges * mean_edge_length(mesh);
        const int depth = least_depth(mesh, detail_size);
        EXPECT_EQ(least_depth(mesh, detail_size, 5), depth);
        EXPECT_GE(cells_per_detail(mesh, detail_size, depth), 2) << edges;
        EXPECT_LT(cells_per_detail(mesh, detail_size, depth - 1), 2) << edges;
    }
    EXPECT_EQ(least_depth(mesh, 1e-9), kMaximumDepth);
}

TEST(ResolvingDepth, TakesCellsAboutAsWideAsTheDefaultDetailAndGreaterDetail) {
    const TriangleMesh mesh = shapes::geodesic_sphere(8);
    const double by_default = kDefaultDetailInEdges * mean_edge_length(mesh);
    for (const double detail_size : {0.995 * by_default, by_default, 1.5 * by_default}) {
        const int depth = least_depth(mesh, detail_size);
        EXPECT_GE(cells_per_detail(mesh, detail_size, depth), 0.9) << detail_size;
        EXPECT_LT(cells_per_detail(mesh, detail_size, depth - 1), 0.9) << detail_size;
    }
}

TEST(AutomaticDepth, IsUpToTwoGreaterForFineDetail) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const int balanced = automatic_depth(mesh);
    for (const int more : {-1, 0, 1, 2}) {
        EXPECT_EQ(automatic_depth(mesh, balanced + more), balanced + std::max(0, more));
    }
    EXPECT_EQ(automatic_depth(mesh, balanced + 3), balanced + 2);
}

TEST(AutomaticDepth, IsNotGreaterThanWhatFits) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const int balanced = automatic_depth(mesh);
    const MemoryCheck unlimited(size_of(Domain(mesh, BoundaryCondition::Free)),
                                enclosing_grid(mesh, 0), {}, 0);
    const auto bytes = static_cast<std::int64_t>(unlimited.flow_bytes(balanced + 1));
    EXPECT_EQ(automatic_depth(mesh, balanced + 2, bytes + 1), balanced + 1);
    EXPECT_EQ(automatic_depth(mesh, balanced + 2, bytes - 1), balanced);
}

TEST(AutomaticDepth, OfThreadsThinnerThanACellCountsTheCellsAlongThem) {
    TriangleMesh threads;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const auto vector = [&] {
            return Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random));
        };
        TriangleMesh thread = shapes::geodesic_sphere(2);
        const Eigen::Vector3d along = vector().normalized(), at = vector();
        for (Eigen::Vector3d& p : thread.positions) p = at + p[0] * along + 1e-6 * p;
        threads = shapes::merged(std::move(threads), thread);
    }
    const auto vertices = static_cast<std::int32_t>(threads.positions.size());
    const std::int32_t unknowns =
        elements_at(threads, automatic_depth(threads)).finest().unknown_count();
    EXPECT_LT(unknowns, 10 * vertices);
}

TEST(AutomaticDepth, RemovesNearlyAsMuchNoiseAsTwoDepthsMore) {
    TriangleMesh mesh = shapes::geodesic_sphere(10);
    const double edge = mean_edge_length(mesh);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-0.2, 0.2);
    for (Eigen::Vector3d& position : mesh.positions) position *= 1 + noise(random) * edge;
    for (const int order : {1, 2}) {
        FlowParameters p;
        p.solver = Solver::Grid;
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
        p.solver = Solver::Grid;
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
