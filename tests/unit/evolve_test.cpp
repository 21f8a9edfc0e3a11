// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/evolve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/not_finite.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(Evolve, ReportsThePapersSizesAndResiduals) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    FlowParameters p = parameters(5, 1e-3, 3);
    p.method = Method::Paper;
    const FlowReport report = evolve(mesh, p);
    EXPECT_EQ(report.vertices, 4002);
    EXPECT_EQ(report.triangles, 8000);
    EXPECT_EQ(report.depth, 5);
    EXPECT_GT(report.cells, 1000);
    EXPECT_EQ(report.elements, report.cells);
    EXPECT_GT(report.unknowns, report.cells);
    EXPECT_GT(report.fragments, report.triangles);
    EXPECT_GT(report.split_triangles, report.fragments);
    EXPECT_EQ(report.samples, 3 * report.split_triangles);
    EXPECT_EQ(report.constrained_unknowns, 0);
    EXPECT_LT(report.area_after, report.area_before);
    EXPECT_GT(report.peak_memory_bytes, 1000000);
    ASSERT_EQ(report.steps.size(), 3U);
    for (const StepReport& step : report.steps) {
        EXPECT_LT(step.residual_after, 0.1 * step.residual_before) << "a cycle of multigrid";
        EXPECT_EQ(step.solver_iterations, 1);
        EXPECT_EQ(step.collapsed_samples, 0);
    }
    EXPECT_NEAR(report.steps[0].area, report.area_before, 1e-6 * report.area_before);
}

TEST(Evolve, ThePapersAutomaticDepthHasAboutAsManyUnknownsAsVertices) {
    for (const TriangleMesh& mesh : {shapes::geodesic_sphere(20), shapes::bumpy_sphere(60),
                                     shapes::torus(120, 40, 1, 0.3), shapes::square(50)}) {
        FlowParameters p = parameters(0, 1e-5, 1);
        p.method = Method::Paper;
        TriangleMesh after = mesh;
        const FlowReport report = evolve(after, p);
        const double ratio =
            static_cast<double>(report.unknowns) / static_cast<double>(report.vertices);
        // For cells of 1.6 edges, 3 unknowns for each squared side and 1.15 vertices for each
        // squared edge. As depths are whole, cells are up to √2 times larger or smaller. A plane
        // along the grid has 2 unknowns instead of 3.
        const double usual = 3 / (1.6 * 1.6 * 1.15);
        EXPECT_GT(ratio, usual / 2 * 2 / 3) << report.depth;
        EXPECT_LT(ratio, usual * 2) << report.depth;
    }
}

TEST(Evolve, ReportsTheOctreeOnlyIfThereIsOne) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    const FlowReport report = evolve(mesh, parameters(5, 1e-3, 3));
    EXPECT_EQ(report.vertices, 4002);
    EXPECT_EQ(report.triangles, 8000);
    EXPECT_EQ(report.unknowns, 4002);
    EXPECT_EQ(report.depth, 5);
    EXPECT_GT(report.cells, 1000);
    EXPECT_EQ(report.elements, report.cells);
    EXPECT_EQ(report.samples, 0);
    EXPECT_NEAR(report.steps[0].area, report.area_before, 1e-6 * report.area_before);
    for (const StepReport& step : report.steps) {
        EXPECT_LE(step.error_estimate, FlowParameters().tolerance);
        EXPECT_LT(step.residual_after, step.residual_before);
    }
    const FlowReport of_default = evolve(mesh, FlowParameters());  // removes short waves
    EXPECT_EQ(of_default.depth, 0);
    EXPECT_EQ(of_default.cells, 0);
}

TEST(Evolve, ReportsHowTheSurfaceChanged) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    mesh.positions.emplace_back(100, 0, 0);  // unused
    const TriangleMesh before = mesh;
    const FlowReport report = evolve(mesh, parameters(5, 1e-3, 3));
    EXPECT_EQ(report.largest_displacement, distance(mesh, before));
    double squares = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        squares += (mesh.positions[i] - before.positions[i]).squaredNorm();
    }
    const double rms = std::sqrt(squares / 4002);
    EXPECT_NEAR(report.rms_displacement, rms, 1e-14 * rms);
    const double change = enclosed_volume(mesh) - enclosed_volume(before);
    EXPECT_NEAR(report.volume_change, change, 1e-12);
    EXPECT_LT(report.volume_change, -0.01);
    EXPECT_NEAR(report.volume_before, enclosed_volume(before), 1e-12);
    mesh = before;
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    const FlowReport flipped = evolve(mesh, parameters(5, 1e-3, 3));
    EXPECT_EQ(flipped.volume_change, report.volume_change);
    EXPECT_EQ(flipped.volume_before, report.volume_before);
    TriangleMesh moebius = shapes::moebius_band(20, 3);
    EXPECT_TRUE(std::isnan(evolve(moebius, FlowParameters()).volume_change));
    mesh.triangles.erase(mesh.triangles.begin());
    EXPECT_TRUE(std::isnan(evolve(mesh, parameters(5, 1e-3, 1)).volume_before)) << "it is open";
    mesh = shapes::box(4, {1, 1, 1});
    const TriangleMesh wall =
        shapes::transformed(shapes::square(4), Eigen::Affine3d(Eigen::Translation3d(0, 0, 0.5)));
    mesh = shapes::merged(mesh, wall);
    const FlowReport walled = evolve(mesh, parameters(5, 1e-4, 1));
    EXPECT_EQ(walled.boundary_edges, 0);
    EXPECT_FALSE(std::isnan(walled.volume_change));
    EXPECT_TRUE(std::isnan(walled.volume_before)) << "a wall inside has the volume on both sides";
}

TEST(Evolve, ReportsOfASoupWhatItReportsOfTheMesh) {
    const TriangleMesh mesh = bumpy_cap(20);
    for (const Method method : {Method::Converged, Method::Paper}) {
        FlowParameters p = parameters(5, 1e-3, 2);
        p.method = method;
        TriangleMesh welded = mesh, soup = shapes::soup(mesh);
        const FlowReport of_mesh = evolve(welded, p), of_soup = evolve(soup, p);
        EXPECT_EQ(of_soup.vertices, of_mesh.vertices);
        EXPECT_EQ(of_soup.held_vertices, of_mesh.held_vertices);
        EXPECT_GT(of_mesh.held_vertices, 0);
        EXPECT_EQ(of_soup.boundary_edges, of_mesh.boundary_edges);
        for (const auto number :
             {&FlowReport::rms_displacement, &FlowReport::largest_displacement,
              &FlowReport::area_before, &FlowReport::area_after, &FlowReport::volume_change}) {
            EXPECT_NEAR(of_soup.*number, of_mesh.*number, 1e-6 * std::abs(of_mesh.*number));
        }
    }
}

TEST(Evolve, ReportsTheVolumeOfTheSelectedPart) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    const TriangleMesh before = mesh;
    const Selection top = above(mesh, 0.3);
    const FlowReport report = evolve(mesh, top, parameters(5, 1e-3, 3));
    // Unselected triangles at the seam do not move, so the whole volume changes as much.
    const double change = enclosed_volume(mesh) - enclosed_volume(before);
    EXPECT_NEAR(report.volume_change, change, 1e-12);
    EXPECT_LT(report.volume_change, -0.01);
    EXPECT_TRUE(std::isnan(report.volume_before));
}

TEST(Evolve, ShowsTheSurfaceAfterEachStep) {
    const TriangleMesh initial = shapes::bumpy_sphere(20);
    FlowParameters p = parameters(5, 1e-3, 3);
    p.preserve = Preserve::Volume;
    std::vector<TriangleMesh> seen;
    const auto on_step = [&](int step, const std::vector<Eigen::Vector3d>& positions) {
        seen.push_back({positions, initial.triangles});
        EXPECT_EQ(step, static_cast<int>(seen.size()));
    };
    TriangleMesh mesh = initial;
    evolve(mesh, {}, p, {}, on_step);
    ASSERT_EQ(seen.size(), 3U);
    EXPECT_TRUE(same_bits(seen.back(), mesh));
    // With a given step size, a flow of fewer steps is the beginning of this one.
    TriangleMesh shorter = initial;
    p.iterations = 2;
    evolve(shorter, p);
    EXPECT_TRUE(same_bits(seen[1], shorter));
}

TEST(Evolve, AFailureOfTheStepObserverLeavesTheMeshAsItWas) {
    const TriangleMesh initial = shapes::bumpy_sphere(10);
    TriangleMesh mesh = initial;
    const auto fail = [](int step, const auto&) {
        if (step == 2) throw std::range_error("full");
    };
    EXPECT_THROW(evolve(mesh, {}, parameters(4, 1e-3, 3), {}, fail), std::range_error);
    EXPECT_TRUE(same_bits(mesh, initial));
}

template <class Exception>
void expect_rejected(const TriangleMesh& mesh, const FlowParameters& p, const std::string& named) {
    TriangleMesh untouched = mesh;
    try {
        evolve(untouched, p);
        ADD_FAILURE() << "accepted: " << named;
    } catch (const Exception& error) {
        EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
    EXPECT_TRUE(same_bits(untouched, mesh));
}

TEST(Evolve, ThePapersAutomaticDepthIsThatOfAnyMesh) {
    // Two triangles that are much smaller than their distance.
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e5, 0, 0}, {1e5, 1, 0}, {1e5, 0, 1}},
                      {{0, 1, 2}, {3, 4, 5}}};
    FlowParameters p;
    p.method = Method::Paper;
    p.boundary = BoundaryCondition::Free;
    EXPECT_EQ(evolve(mesh, p).depth, kMaximumDepth);
    for (Eigen::Vector3d& position : mesh.positions) position = {1, 2, 3};
    expect_rejected<InvalidMesh>(mesh, p, "degenerate");
}

// No host offers them, so the table of parameters has no row for them.
TEST(Evolve, RefusesNumbersOfCyclesOutOfRange) {
    for (const int cycles : {0, 1001}) {
        FlowParameters p;
        p.cycles = cycles;
        expect_rejected<InvalidParameter>(shapes::bumpy_sphere(5), p, "cycles");
    }
}

TEST(Evolve, RefusesWhatThePapersMethodDoesNotHave) {
    const TriangleMesh mesh = shapes::bumpy_sphere(6);
    FlowParameters paper;
    paper.method = Method::Paper;
    FlowParameters p = paper;
    p.flow = FlowKind::Conformalized;
    expect_rejected<InvalidParameter>(mesh, p, "flow asks for what the method Paper");
    p = paper;
    p.preserve = Preserve::Area;
    expect_rejected<InvalidParameter>(mesh, p, "preserve asks for");
    TriangleMesh after = mesh;
    EXPECT_THROW(evolve(after, Selection(mesh.triangles.size(), 1), paper), InvalidParameter);
    EXPECT_THROW(evolve(after, Inputs({}, std::vector<double>(mesh.positions.size(), 1)), paper),
                 InvalidParameter);
    EXPECT_TRUE(same_bits(after, mesh));
}

TEST(Evolve, SaysWhichNumbersAParameterMayBe) {
    const auto complaint = [](const FlowParameters& p) -> std::string {
        try {
            validate(p);
        } catch (const InvalidParameter& error) {
            return error.what();
        }
        return "none";
    };
    FlowParameters p;
    p.step_size = kInfinity;
    EXPECT_EQ(complaint(p),
              "step_size is inf; give 0 or more, in squared units of the mesh, where 0 takes that "
              "of the detail size.");
    p.step_size = 0;
    p.detail_size = -1;
    EXPECT_EQ(complaint(p),
              "detail_size is -1; give 0 or more, in units of the mesh, where 0 takes 3 mean edge "
              "lengths.");
    p.detail_size = 0;
    p.order = 5;
    EXPECT_EQ(complaint(p), "order is 5; give 1 to 4.");
    for (p.order = 1; p.order <= kMaximumOrder; ++p.order) EXPECT_EQ(complaint(p), "none");
    p.order = 1;
    p.tolerance = 1;
    EXPECT_EQ(complaint(p),
              "tolerance is 1; give a number greater than 0 and less than 1, such as 1e-3.");
    p.tolerance = 1e-10;
    EXPECT_EQ(complaint(p), "none");
}

TEST(Evolve, AcceptsAnyStepSize) {
    // A step size of 1e-320 moves nothing. Any step size that is large relative to the mesh, such
    // as 1e9 or 1e308, gives the same result.
    const TriangleMesh cap = bumpy_cap(10);
    FlowParameters p = parameters(4, 1e-320, 2);
    EXPECT_LT(distance(evolved(cap, p), cap), 1e-12);
    p.step_size = 1e308;
    const TriangleMesh far = evolved(cap, p);
    p.step_size = 1e9;
    EXPECT_TRUE(same_bits(far, evolved(cap, p)));
}

TEST(Evolve, ReachesATightToleranceOrReportsThatItDidNot) {
    FlowParameters p = parameters(4, 1e-3, 2);
    for (const double tolerance : {1e-10, 1e-30}) {  // double precision cannot reach the second
        p.tolerance = tolerance;
        TriangleMesh mesh = shapes::bumpy_sphere(10);
        for (const StepReport& step : evolve(mesh, p).steps) {
            EXPECT_EQ(step.reached_tolerance, tolerance == 1e-10);
            EXPECT_EQ(step.reached_tolerance, step.error_estimate <= tolerance);
            EXPECT_GT(step.solver_iterations, 3);
        }
    }
}

TEST(Evolve, ReachesTheToleranceInStepsTooSmallToSee) {
    for (const double size : {1e7, 1e13, 1e30}) {
        FlowParameters p = parameters(4, 1e-8, 3);
        TriangleMesh mesh =
            shapes::transformed(shapes::bumpy_sphere(10), Eigen::Affine3d(Eigen::Scaling(size)));
        const FlowReport report = evolve(mesh, p);
        EXPECT_EQ(report.stop, Stop::None) << size;
        for (const StepReport& step : report.steps) {
            EXPECT_TRUE(step.reached_tolerance) << size;
            EXPECT_TRUE(std::isfinite(step.residual_after)) << size;
        }
    }
}

TEST(Evolve, ReachesTheToleranceAmongManySmallHoles) {
    // Small pieces between holes have functions with much energy, for which the V-cycle overshoots.
    TriangleMesh mesh = shapes::bumpy_sphere(12);
    std::mt19937 random(3);
    const auto in_hole = [&](const Triangle&) { return random() % 7 == 0; };
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), in_hole),
                         mesh.triangles.end());
    FlowParameters p;
    p.depth = 6;
    const TriangleMesh usual = evolved(mesh, p);
    p.tolerance = 1e-5;
    const TriangleMesh exact = evolved(mesh, p);
    double error = 0, movement = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        error += (usual.positions[i] - exact.positions[i]).squaredNorm();
        movement += (exact.positions[i] - mesh.positions[i]).squaredNorm();
    }
    // The tolerance, for each of the two solves of a step of second order.
    EXPECT_LT(std::sqrt(error / movement), 2 * FlowParameters().tolerance);
}

TEST(Evolve, RejectsMeshesThatCannotFlow) {
    const FlowParameters p = parameters(3, 1e-3, 1);
    expect_rejected<InvalidMesh>(TriangleMesh(), p, "empty");
    TriangleMesh mesh = shapes::bumpy_sphere(5);
    mesh.triangles.clear();
    expect_rejected<InvalidMesh>(mesh, p, "no faces");
    for (const double bad : {kNaN, kInfinity}) {
        mesh = shapes::bumpy_sphere(5);
        mesh.positions[3][1] = bad;
        expect_rejected<InvalidMesh>(mesh, p, "finite");
    }
    mesh = shapes::bumpy_sphere(5);
    for (auto& position : mesh.positions) position.tail<2>().setZero();
    expect_rejected<InvalidMesh>(mesh, p, "degenerate");
    for (auto& position : mesh.positions) position.setZero();
    expect_rejected<InvalidMesh>(mesh, p, "degenerate");
    for (const double far : {1e16, 1e308}) {
        mesh = shapes::bumpy_sphere(5);
        for (auto& position : mesh.positions) position[2] += far;
        expect_rejected<InvalidMesh>(mesh, p, "origin");
    }
}

}  // namespace
}  // namespace tracked_mcf
