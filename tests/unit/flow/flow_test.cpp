// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <type_traits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/solver/conjugate_gradients.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A flow has references to its own members.
static_assert(!std::is_copy_constructible_v<Flow> && !std::is_move_constructible_v<Flow>);

TEST(Flow, OneStepShrinksTheSphereToTheSemiImplicitRadius) {
    // r(t+δ) = r³ / (r² + 2δ), section 5.2; the unit sphere's longest side is 2.
    TriangleMesh mesh = shapes::geodesic_sphere(40);
    evolve(mesh, parameters(5, 1e-3, 1));
    for (const Eigen::Vector3d& position : mesh.positions) {
        EXPECT_NEAR(position.norm(), 1 / (1 + 2 * 4e-3), 3e-4);
    }
}

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
    p.solver = Solver::OneWCycle;
    EXPECT_LT(largest_effect_of_noise(p), 2e-5);
}

TEST(Flow, NoiseHardlyChangesTheFlowOfAPlateauInAGridPlaneWhenStabilized) {
    // Noise adds cells on the other side of the plateau. At its border the stabilisation then
    // couples other functions. The effect is a small part of the discretisation error.
    const FlowParameters p = parameters(5, 1e-4, 10);
    const TriangleMesh mesh = sphere_with_plateau();
    const double of_depth = distance(evolved(mesh, p), evolved(mesh, parameters(7, 1e-4, 10)));
    EXPECT_LT(largest_effect_of_noise(p), 0.2 * of_depth);
}

TEST(Flow, LockedBoundaryVerticesKeepTheirBits) {
    TriangleMesh cap = shapes::bumpy_sphere(20);
    cap.triangles.resize(cap.triangles.size() / 2);
    const TriangleMesh after = evolved(cap, parameters(5, 1e-4, 5));
    const auto boundary = boundary_edges(topology_of(cap));
    int checked = 0;
    for (std::size_t t = 0; t < cap.triangles.size(); ++t) {
        for (int edge = 0; edge < 3; ++edge) {
            if (((boundary[t] >> edge) & 1) == 0) continue;
            const std::int32_t vertex = cap.triangles[t][edge];
            EXPECT_EQ(after.positions[vertex], cap.positions[vertex]);
            ++checked;
        }
    }
    EXPECT_GT(checked, 40);
    EXPECT_GT(distance(after, cap), 1e-3);
}

TEST(Flow, FreeBoundaryMoves) {
    FlowParameters p = parameters(5, 1e-3, 3);
    p.boundary = BoundaryCondition::Free;
    const TriangleMesh patch = shapes::square(30);
    const TriangleMesh after = evolved(patch, p);
    EXPECT_LT(surface_area(after), 0.95);
    for (const auto& position : after.positions) EXPECT_NEAR(position[2], 0, 1e-6);
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
    // Large enough for many blocks and several slabs of cells.
    const TriangleMesh mesh = shapes::bumpy_sphere(60);
    FlowParameters p = parameters(7, 1e-4, 2);
    for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
        p.solver = solver;
        expect_same_bits_at_any_number_of_threads(mesh, p);
    }
    p.solver = Solver::Converged;
    expect_same_bits_at_any_number_of_threads(bumpy_cap(60), p);
    p.flow = FlowKind::Conformalized;
    p.preserve = Preserve::Volume;
    expect_same_bits_at_any_number_of_threads(mesh, p);
}

TEST(Flow, ThrowsWhenItsNumbersAreNotFinite) {
    for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
        FlowParameters p = parameters(4, 1e-4, 1);
        p.solver = solver;
        p.stabilization = std::numeric_limits<double>::quiet_NaN();  // validate() rejects it
        Flow flow(shapes::bumpy_sphere(10), p);
        EXPECT_THROW(flow.step(), NumericalFailure);
        EXPECT_TRUE(flow.displacement().isZero(0));
    }
}

TEST(Flow, SoupFlowsLikeItsMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(15);
    const TriangleMesh soup = shapes::soup(mesh);
    const FlowParameters p = parameters(0, 1e-3, 4);
    EXPECT_TRUE(same_bits(evolved(soup, p), shapes::soup(evolved(mesh, p))));
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
        EXPECT_LT(report.area_after, 0.05 * report.area_before);
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
    const TriangleMesh before = mesh;
    const FlowReport report = evolve(mesh, parameters(6, 2e-4, 60));
    EXPECT_GT(report.steps.back().collapsed_samples, 100);
    Eigen::AlignedBox3d box;
    for (const auto& position : before.positions) box.extend(position);
    for (const auto& position : mesh.positions) EXPECT_TRUE(box.contains(position));
}

TEST(Flow, UnreferencedVerticesKeepTheirBits) {
    TriangleMesh mesh = shapes::bumpy_sphere(10);
    mesh.positions.emplace_back(1000, -0.0, kNaN);
    const TriangleMesh after = evolved(mesh, parameters(4, 1e-3, 2));
    const TriangleMesh last_before{{mesh.positions.back()}, {}};
    const TriangleMesh last_after{{after.positions.back()}, {}};
    EXPECT_TRUE(same_bits(last_before, last_after));
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

TEST(Evolve, ReportsSizesAndResiduals) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    const FlowReport report = evolve(mesh, parameters(5, 1e-3, 3));
    EXPECT_EQ(report.vertices, 4002);
    EXPECT_EQ(report.triangles, 8000);
    EXPECT_EQ(report.depth, 5);
    EXPECT_GT(report.cells, 1000);
    EXPECT_GT(report.unknowns, report.cells);
    EXPECT_GT(report.fragments, report.triangles);
    EXPECT_GT(report.split_triangles, report.fragments);
    EXPECT_EQ(report.samples, 3 * report.split_triangles);
    EXPECT_EQ(report.constrained_unknowns, 0);
    EXPECT_LT(report.area_after, report.area_before);
    EXPECT_GT(report.peak_memory_bytes, 1000000);
    ASSERT_EQ(report.steps.size(), 3U);
    for (const StepReport& step : report.steps) {
        EXPECT_LT(step.residual_after, 0.2 * step.residual_before);
        EXPECT_EQ(step.collapsed_samples, 0);
    }
    EXPECT_NEAR(report.steps[0].area, report.area_before, 1e-6 * report.area_before);
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
    EXPECT_TRUE(report.oriented_consistently);
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    EXPECT_FALSE(evolve(mesh, parameters(5, 1e-3, 1)).oriented_consistently);
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
}

TEST(Evolve, ProgressRisesFromZeroToOne) {
    TriangleMesh mesh = shapes::bumpy_sphere(5);
    std::vector<double> fractions;
    evolve(mesh, parameters(3, 1e-3, 4), [&](double fraction, std::string_view phase) {
        EXPECT_FALSE(phase.empty());
        fractions.push_back(fraction);
        return true;
    });
    EXPECT_EQ(fractions.front(), 0);
    EXPECT_EQ(fractions.back(), 1);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_GE(fractions.size(), 6U);
}

/// Calls the callback only when a phase begins, never because time has passed.
void evolve_by_phases(TriangleMesh& mesh, const Progress& progress) {
    const ProgressMeter meter(progress, std::chrono::hours(1));
    evolve(mesh, parameters(3, 1e-3, 4));
}

TEST(Evolve, CancellingLeavesTheMeshAsItWas) {
    const TriangleMesh mesh = shapes::bumpy_sphere(5);
    int calls = 0;
    TriangleMesh whole = mesh;
    evolve_by_phases(whole, [&](double, std::string_view) { return ++calls > 0; });
    EXPECT_GE(calls, 6);
    for (int last = 1; last <= calls; ++last) {
        TriangleMesh stopped = mesh;
        int left = last;
        EXPECT_THROW(
            evolve_by_phases(stopped, [&](double, std::string_view) { return --left > 0; }),
            Cancelled);
        EXPECT_TRUE(same_bits(stopped, mesh));
    }
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

TEST(Evolve, RejectsParametersOutOfRangeAndNamesThem) {
    const TriangleMesh mesh = shapes::bumpy_sphere(5);
    for (const int depth : {-1, 13, 1000}) {
        expect_rejected<InvalidParameter>(mesh, parameters(depth, 1e-3, 1), "depth");
    }
    for (const int iterations : {-5, 0, 1000001}) {
        expect_rejected<InvalidParameter>(mesh, parameters(3, 1e-3, iterations), "iterations");
    }
    for (const double step : {-1e-5, 1e36, kNaN, kInfinity, -kInfinity}) {
        expect_rejected<InvalidParameter>(mesh, parameters(3, step, 1), "step_size");
    }
    FlowParameters p = parameters(3, 1e-3, 1);
    p.absolute = true;
    for (const double step : {-1e-5, kNaN, kInfinity, -kInfinity}) {
        p.step_size = step;
        expect_rejected<InvalidParameter>(mesh, p, "step_size");
    }
    p.step_size = 1;
    for (const double detail_size : {-1e-5, kNaN, kInfinity, -kInfinity}) {
        p.detail_size = detail_size;
        expect_rejected<InvalidParameter>(mesh, p, "detail_size");
    }
    p.detail_size = 0;
    for (const int order : {-1, 0, 5}) {
        p.order = order;
        expect_rejected<InvalidParameter>(mesh, p, "order");
    }
    p.order = 1;
    for (const double penalty : {0.0, -1.0, 1e7, kNaN, kInfinity}) {
        p.boundary_penalty = penalty;
        expect_rejected<InvalidParameter>(mesh, p, "boundary_penalty");
    }
    p.boundary_penalty = 10;
    p.cycles = 0;
    expect_rejected<InvalidParameter>(mesh, p, "cycles");
    p.cycles = 1;
    p.threads = -2;
    expect_rejected<InvalidParameter>(mesh, p, "threads");
    p.threads = 0;
    for (const double tolerance : {0.0, -1e-3, 1.0, 2.0, kNaN, kInfinity}) {
        p.tolerance = tolerance;
        expect_rejected<InvalidParameter>(mesh, p, "tolerance");
    }
    p.tolerance = 1e-3;
    for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
        p.solver = solver;
        for (const double weight : {-1e-9, 1001.0, kNaN, kInfinity, -kInfinity}) {
            p.stabilization = weight;
            expect_rejected<InvalidParameter>(mesh, p, "stabilization");
        }
    }
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
    EXPECT_EQ(
        complaint(p),
        "step_size is inf; give a number greater than 0 and at most 1e+09, such as 1e-5, or 0 "
        "to take the detail size.");
    p.absolute = true;
    EXPECT_EQ(complaint(p),
              "step_size is inf; give a number greater than 0, in squared units of the mesh, or 0 "
              "to take the detail size.");
    p.absolute = false;
    p.step_size = 0;
    p.detail_size = -1;
    EXPECT_EQ(
        complaint(p),
        "detail_size is -1; give a number greater than 0, a length in units of the mesh, or 0 "
        "to take 2.5 mean edge lengths.");
    p.detail_size = 0;
    p.order = 5;
    EXPECT_EQ(complaint(p), "order is 5; give 1 to 4.");
    for (p.order = 1; p.order <= kMaximumOrder; ++p.order) EXPECT_EQ(complaint(p), "none");
    p.order = 1;
    p.tolerance = 1;
    EXPECT_EQ(complaint(p),
              "tolerance is 1; give a number greater than 0 and less than 1, such as 1e-3.");
    p.tolerance = 1e-10;
    p.stabilization = -1;
    EXPECT_EQ(complaint(p),
              "stabilization is -1; give a number from 0, which is none, to 1000, such as 0.01.");
    for (const double weight : {0.0, kMaximumStabilization}) {
        p.stabilization = weight;
        EXPECT_EQ(complaint(p), "none");
    }
}

TEST(Evolve, AcceptsAnyAbsoluteStepSize) {
    // A step size of 1e-320 moves nothing. Any step size that is large relative to the mesh, such
    // as 1e9 or 1e308, gives the same result.
    const TriangleMesh cap = bumpy_cap(10);
    FlowParameters p = parameters(4, 1e-320, 2);
    p.absolute = true;
    EXPECT_LT(distance(evolved(cap, p), cap), 1e-12);
    p.step_size = 1e308;
    const TriangleMesh far = evolved(cap, p);
    p.step_size = 1e9;
    EXPECT_TRUE(same_bits(far, evolved(cap, p)));
}

TEST(Evolve, StabilizesTheConvergedSolverByDefault) {
    FlowParameters p;
    EXPECT_EQ(stabilization_of(p), kDefaultStabilization);
    p.solver = Solver::OneWCycle;
    EXPECT_EQ(stabilization_of(p), 0);
    p.stabilization = 0.1;
    EXPECT_EQ(stabilization_of(p), 0.1);
    p.solver = Solver::Converged;
    p.stabilization = 0;
    EXPECT_EQ(stabilization_of(p), 0);
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
            EXPECT_LE(step.solver_iterations, kMaximumSolverIterations);
        }
    }
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

TEST(Evolve, HugeStepsAndTinyMeshesStayFinite) {
    const TriangleMesh mesh = shapes::bumpy_sphere(8);
    for (const double step : {1e-12, 1.0, kMaximumStepSize}) {
        const TriangleMesh after = evolved(mesh, parameters(4, step, 3));
        for (const auto& position : after.positions) EXPECT_TRUE(position.allFinite());
        EXPECT_LE(surface_area(after), surface_area(mesh));
    }
    TriangleMesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    FlowParameters p = parameters(0, 1e-5, 10);
    p.boundary = BoundaryCondition::Free;
    for (const auto& position : evolved(triangle, p).positions) EXPECT_TRUE(position.allFinite());
}

TEST(Evolve, ClosedMeshesStayInTheirBoxAtAnyStepSize) {
    const TriangleMesh mesh = shapes::bumpy_sphere(16);
    const Grid box = enclosing_grid(mesh, 0);
    for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
        for (const double step : {1.0, 1e2, 1e4, 1e6, kMaximumStepSize}) {
            FlowParameters p = parameters(6, step, 2);
            p.solver = solver;
            for (const auto& position : evolved(mesh, p).positions) {
                const Eigen::Vector3d local = box.to_grid(position);
                EXPECT_GT(local.minCoeff(), 0) << step;
                EXPECT_LT(local.maxCoeff(), 1) << step;
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
