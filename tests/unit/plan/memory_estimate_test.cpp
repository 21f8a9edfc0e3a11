// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/memory_estimate.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#include <unistd.h>
#endif

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "tests/support/elements.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

FlowParameters free_at(int depth) {
    FlowParameters p = parameters(depth, 1e-5, 1);
    p.solver = Solver::Grid;
    p.boundary = BoundaryCondition::Free;
    return p;
}

/// Returns the elements of a surface in a grid.
TrackedElements elements_of(const Domain& domain, const Grid& grid, const FlowParameters& p) {
    return build_tracked_elements(domain, clip_to_grid(domain.surface(), grid),
                                  discretisation_of(p));
}

/// Expects that the counts agree with those of the flow within 4 %. Only the samples of the paper's
/// solver are known so exactly.
void expect_counts(const TriangleMesh& mesh, FlowParameters p) {
    p.solver = Solver::OneWCycle;
    const Domain domain(mesh, p.boundary);
    const Grid grid = enclosing_grid(mesh, p.depth);
    const ExpectedCounts counts = expected_counts(size_of(domain), grid, discretisation_of(p));
    const TrackedElements elements = elements_of(domain, grid, p);
    const auto expect_near = [](double expected, std::size_t number) {
        const auto counted = static_cast<double>(number);
        EXPECT_NEAR(expected, counted, 0.04 * counted);
    };
    expect_near(counts.fragments, elements.fragments.size());
    expect_near(counts.samples, elements.samples.size());
    expect_near(counts.elements, elements.finest().cells.size());
    expect_near(counts.unknowns, static_cast<std::size_t>(elements.finest().unknown_count()));
}

TEST(ExpectedCounts, AgreeWithTheCountsOfAFlow) {
    expect_counts(shapes::geodesic_sphere(40), free_at(5));
    expect_counts(shapes::geodesic_sphere(5), free_at(7));
    expect_counts(shapes::box(1, {1, 0.8, 0.6}), free_at(7));
    expect_counts(shapes::soup(shapes::bumpy_sphere(30)), free_at(5));
    expect_counts(shapes::tube(90, 30, 2), free_at(6));
    expect_counts(shapes::separate_triangles(2000), free_at(2));
    expect_counts(shapes::separate_triangles(2000), free_at(7));
}

TEST(ExpectedCounts, DoNotTakeLongSidesForALongRim) {
    expect_counts(turned(shapes::fan(3000), 1, {1, 2, 3}), free_at(7));
    expect_counts(turned(shapes::tube(1000, 1, 2), 1, {1, 2, 3}), free_at(7));
}

TEST(ExpectedCounts, CountCopiesOfTrianglesAsOneSurface) {
    expect_counts(shapes::stack(shapes::bumpy_sphere(60), 3, 0), free_at(4));
    expect_counts(shapes::stack(shapes::box(1, {1, 0.8, 0.6}), 10, 0), free_at(7));
}

TEST(ExpectedCounts, SubtractHoles) {
    TriangleMesh holes = shapes::square(60);
    for (std::size_t i = 0; 3 * i < holes.triangles.size(); ++i)
        holes.triangles[i] = holes.triangles[3 * i];
    holes.triangles.resize(holes.triangles.size() / 3);
    expect_counts(turned(holes, 1, {1, 2, 3}), free_at(8));
}

TEST(ExpectedCounts, CountSheetsSeparatelyOrPerCell) {
    const TriangleMesh sphere = shapes::geodesic_sphere(20);
    const TriangleMesh mesh =
        shapes::merged(sphere, shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(1.001))));
    expect_counts(mesh, free_at(5));

    FlowParameters together = free_at(1);
    together.separate_sheets = false;
    const Domain domain(mesh, together.boundary);
    const ExpectedCounts counts =
        expected_counts(size_of(domain), enclosing_grid(mesh, 1), discretisation_of(together));
    EXPECT_LE(counts.elements, 8) << "there are no more cells";
    EXPECT_LE(counts.unknowns, 27);
}

TEST(ExpectedCounts, KnowThatSmallFragmentsHaveFewerSamples) {
    const TriangleMesh mesh = shapes::geodesic_sphere(20);
    const Domain domain(mesh, BoundaryCondition::Free);
    for (int depth = 3; depth <= 8; ++depth) {
        const FlowParameters p = free_at(depth);
        const Grid grid = enclosing_grid(mesh, depth);
        const auto counted = static_cast<double>(elements_of(domain, grid, p).samples.size());
        EXPECT_NEAR(expected_counts(size_of(domain), grid, discretisation_of(p)).samples, counted,
                    0.1 * counted)
            << depth;
    }
}

TEST(SurfaceSize, OfAPartIsThatOfThePartAlone) {
    const TriangleMesh sphere = shapes::geodesic_sphere(40);
    const Selection selection = above(sphere, 0.3);
    const SurfaceSize selected = size_of(Domain(sphere, selection, BoundaryCondition::Free));
    const TriangleMesh part = part_of(sphere, selection);
    const SurfaceSize alone = size_of(Domain(part, BoundaryCondition::Free));
    EXPECT_EQ(selected.triangles, alone.triangles);
    EXPECT_EQ(selected.extents, alone.extents);
    EXPECT_EQ(selected.shadows, alone.shadows);
    EXPECT_NEAR(selected.rim, alone.rim, 1e-9);
    EXPECT_EQ(selected.characteristic, alone.characteristic);
}

TEST(MemoryEstimate, GrowsWithTheDepthLikeTheAreaInCells) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const FlowParameters p = free_at(8);
    const SurfaceSize size = size_of(Domain(mesh, p.boundary));
    const auto bytes = [&](int depth) {
        return estimate_flow_bytes(size, enclosing_grid(mesh, depth), p);
    };
    for (int depth = 1; depth < kMaximumDepth; ++depth) EXPECT_GT(bytes(depth + 1), bytes(depth));
    EXPECT_NEAR(bytes(12) / bytes(11), 4, 0.1);
}

/// Returns the resident memory of this process, or 0 if the system does not report it.
std::int64_t resident_bytes() {
#ifdef __GLIBC__
    // Else malloc would keep what is freed: the flow would reuse it, and holes would count as used.
    mallopt(M_MMAP_THRESHOLD, 128 * 1024);
    malloc_trim(0);
    std::ifstream statm("/proc/self/statm");
    std::int64_t size = 0, resident = 0;
    if (statm >> size >> resident) return resident * sysconf(_SC_PAGESIZE);
#endif
    return 0;
}

/// Expects that a flow takes the estimated memory, with a ratio of the estimate to the memory from
/// `least` to `most`.
void expect_estimate(TriangleMesh mesh, FlowParameters p, double least = 0.8, double most = 1.3) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers take memory of their own";
    p.threads = 2;
    p.boundary = BoundaryCondition::Free;  // else separate triangles would be constrained
    const std::int64_t before = resident_bytes();
    const std::int64_t peak_before = peak_memory_bytes();
    if (before == 0 || peak_before == 0) GTEST_SKIP() << "the system does not report memory";
    const FlowReport report = evolve(mesh, p);
    if (report.peak_memory_bytes <= peak_before) {
        GTEST_SKIP() << "an earlier test in this process took more memory";
    }
    const auto actual = static_cast<double>(report.peak_memory_bytes - before);
    const auto estimate = static_cast<double>(report.estimated_memory_bytes - before);
    EXPECT_GT(estimate, least * actual);
    EXPECT_LT(estimate, most * actual);
}

TEST(MemoryOfAFlow, OfAFineMesh) {
    expect_estimate(shapes::bumpy_sphere(100), free_at(0));
}

TEST(MemoryOfAFlow, ThatMeasuresTheDisplacement) {
    FlowParameters p = free_at(0);
    p.quality = Quality::Displacement;
    expect_estimate(shapes::bumpy_sphere(100), p);
}

TEST(MemoryOfAFlow, OnTheMesh) {
    FlowParameters p = free_at(0);
    p.solver = Solver::Converged;
    p.order = 2;
    expect_estimate(shapes::bumpy_sphere(200), p, 0.9, 1.5);
}

TEST(MemoryOfAFlow, OnTheMeshWithAnOctree) {
    FlowParameters p = free_at(0);
    p.solver = Solver::Converged;
    p.step_size = 1e-3;
    p.preserve = Preserve::Volume;
    expect_estimate(shapes::bumpy_sphere(200), p, 0.9, 1.5);
}

TEST(MemoryOfAFlow, OfFewLargeTriangles) {
    expect_estimate(shapes::box(1, {1, 0.8, 0.6}), free_at(8));
}

TEST(MemoryOfAFlow, OfASoup) {
    expect_estimate(shapes::soup(shapes::geodesic_sphere(100)), free_at(0));
}

TEST(MemoryOfAFlow, OfAnOpenTube) {
    expect_estimate(shapes::tube(450, 150, 2), free_at(0));
}

TEST(MemoryOfAFlow, OfSeparateTriangles) {
    FlowParameters p = free_at(5);
    p.step_size = 1;  // a short step leaves the coarse levels idle, here as large as the finest
    expect_estimate(shapes::separate_triangles(20000), p);
}

TEST(MemoryOfAFlow, OfAFan) {
    expect_estimate(shapes::fan(5000), free_at(0));
}

TEST(MemoryOfAFlow, OfNeedles) {
    expect_estimate(shapes::tube(4000, 1, 2), free_at(0));
}

TEST(MemoryOfAFlow, OfCopiesOfAMesh) {
    expect_estimate(shapes::stack(shapes::geodesic_sphere(40), 10, 0), free_at(0));
}

TEST(MemoryOfAFlow, OfAStackOfSheets) {
    expect_estimate(shapes::stack(shapes::square(9), 500, 1e-6), free_at(3));
}

TEST(MemoryOfAFlow, OfAFlatStrip) {
    const Eigen::Affine3d flattened(Eigen::Scaling(1.0, 1e-6, 1.0));
    expect_estimate(shapes::transformed(shapes::square(199), flattened), free_at(0));
}

TEST(MemoryOfAFlow, OfAMeshThatIsFinerThanTheGrid) {
    expect_estimate(shapes::geodesic_sphere(160), free_at(4));
}

/// Expects a close estimate on a grid so fine that most of its cells hold part of one triangle.
void expect_close_estimate(const TriangleMesh& mesh, int depth,
                           const std::function<void(FlowParameters&)>& set = {}) {
    FlowParameters p = free_at(depth);
    p.step_size = 1e-3;  // uses all levels
    if (set) set(p);
    expect_estimate(mesh, p, 0.9, 1.15);
}

TEST(MemoryOfAFineGrid, OfOneTriangle) {
    expect_close_estimate(shapes::separate_triangles(1), 8);
}

TEST(MemoryOfAFineGrid, OfASphere) {
    expect_close_estimate(shapes::geodesic_sphere(15), 8);
}

TEST(MemoryOfAFineGrid, OfABox) {
    expect_close_estimate(shapes::box(1, {1, 0.8, 0.6}), 8);
}

TEST(MemoryOfAFineGrid, WithJoinedSheets) {
    expect_close_estimate(shapes::geodesic_sphere(15), 7,
                          [](FlowParameters& p) { p.separate_sheets = false; });
}

TEST(MemoryOfAFineGrid, SolvedByWCycles) {
    expect_close_estimate(shapes::separate_triangles(1), 8,
                          [](FlowParameters& p) { p.solver = Solver::OneWCycle; });
}

TEST(MemoryOfAFineGrid, OfOrderFour) {
    expect_close_estimate(shapes::geodesic_sphere(15), 7, [](FlowParameters& p) { p.order = 4; });
}

TEST(MemoryOfAFineGrid, PreservingTheArea) {
    expect_close_estimate(shapes::geodesic_sphere(15), 7, [](FlowParameters& p) {
        p.preserve = Preserve::Area;
        p.iterations = 2;  // the first step makes the prediction for the second
    });
}

TEST(MemoryOfAFineGrid, WithTheMeanCurvature) {
    expect_close_estimate(shapes::separate_triangles(1), 8, [](FlowParameters& p) {
        p.quality = Quality::MeanCurvature;
        p.iterations = 3;  // the velocities of one state more in each step
    });
}

TEST(MemoryOfAFineGrid, PreservingTheVolume) {
    expect_close_estimate(shapes::geodesic_sphere(15), 7,
                          [](FlowParameters& p) { p.preserve = Preserve::Volume; });
}

TEST(MemoryOfAFlow, SolvedByWCycles) {
    FlowParameters p = free_at(8);
    p.solver = Solver::OneWCycle;
    expect_estimate(shapes::bumpy_sphere(60), p);
}

}  // namespace
}  // namespace tracked_mcf
