// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/mesh_flow.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Parameters with a step size in squared units of the mesh.
FlowParameters on_mesh(double step_size, int iterations, int depth = 0) {
    FlowParameters p = parameters(depth, 0, iterations);
    p.step_size = step_size;
    return p;
}

struct Evolved {
    TriangleMesh mesh;
    FlowReport report;
};

Evolved evolve_copy(const TriangleMesh& mesh, const FlowParameters& p) {
    Evolved result{mesh, {}};
    result.report = evolve(result.mesh, p);
    return result;
}

/// Returns a mesh's part with the vertices from `begin` on, without its triangles.
TriangleMesh vertices_from(const TriangleMesh& mesh, std::size_t begin, std::size_t count) {
    const auto first = mesh.positions.begin() + static_cast<std::ptrdiff_t>(begin);
    return {{first, first + static_cast<std::ptrdiff_t>(count)}, {}};
}

/// Pages around the z axis from z = 0 to 1 and from the radius 0 to 1, n by n quads each, that
/// share the vertices of the axis.
TriangleMesh book(int n, const std::vector<double>& angles) {
    TriangleMesh mesh;
    for (int k = 0; k <= n; ++k) mesh.positions.emplace_back(0, 0, double(k) / n);
    for (const double angle : angles) {
        const auto first = static_cast<std::int32_t>(mesh.positions.size());
        const auto vertex = [&](int i, int k) {
            return i == 0 ? k : first + (i - 1) * (n + 1) + k;
        };
        for (int i = 1; i <= n; ++i) {
            for (int k = 0; k <= n; ++k) {
                const double radius = double(i) / n;
                mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                            double(k) / n);
            }
        }
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < n; ++k) {
                mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
                mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
            }
        }
    }
    return mesh;
}

/// Moves three vertices of a unit sphere about as far away as `length`.
TriangleMesh with_spikes(TriangleMesh mesh, double length) {
    mesh.positions[0] += length * Eigen::Vector3d(0.3, 0.5, 0.8);
    mesh.positions[7] += length * Eigen::Vector3d(-0.8, 0.2, 0.1);
    mesh.positions[12] += length * Eigen::Vector3d(-0.2, -0.7, -0.5);
    return mesh;
}

TEST(MeshFlow, UsesAnOctreeForLongWavesOrOnDemand) {
    const TriangleMesh sphere = shapes::geodesic_sphere(24);  // edges of 0.05
    const Evolved short_waves = evolve_copy(sphere, on_mesh(1e-4, 1));
    EXPECT_EQ(short_waves.report.depth, 0);
    EXPECT_EQ(short_waves.report.elements, 0);
    const Evolved asked = evolve_copy(sphere, on_mesh(1e-4, 1, 3));
    EXPECT_EQ(asked.report.depth, 3);
    EXPECT_GT(asked.report.elements, 0);
    EXPECT_NEAR(asked.report.cell_size, 2 * 1.1 / 8, 0.01);
    const Evolved long_waves = evolve_copy(sphere, on_mesh(0.1, 1));
    EXPECT_GT(long_waves.report.depth, 0);
    EXPECT_GE(long_waves.report.cell_size, 3 * long_waves.report.mean_edge);
    for (const Evolved* of : {&short_waves, &asked, &long_waves}) {
        EXPECT_EQ(of->report.unknowns, static_cast<std::int64_t>(sphere.positions.size()));
    }
}

TEST(MeshFlow, TheOctreeChangesTheResultByLessThanTheTolerance) {
    for (const TriangleMesh& mesh : {noisy(shapes::bumpy_sphere(20), 0.005), bumpy_cap(20)}) {
        for (const double step : {1e-4, 1e-2}) {
            for (const double tolerance : {1e-3, 1e-6}) {
                FlowParameters p = on_mesh(step, 3);
                p.tolerance = tolerance;
                const Evolved automatic = evolve_copy(mesh, p);
                for (const int depth : {2, 4}) {
                    p.depth = depth;
                    const Evolved other = evolve_copy(mesh, p);
                    EXPECT_EQ(other.report.depth, depth);
                    const double moved = automatic.report.rms_displacement;
                    EXPECT_LT(rms_distance(other.mesh, automatic.mesh), tolerance * moved);
                }
            }
        }
    }
}

TEST(MeshFlow, OrderOneStaysInTheBoxOfEachComponentAtAnyTolerance) {
    // The vertices of flat faces would leave the box by every error along their normals.
    const TriangleMesh part = shapes::box(8, {1, 0.7, 0.4});
    const std::size_t count = part.positions.size();
    const TriangleMesh mesh = shapes::merged(
        part, shapes::transformed(part, Eigen::Affine3d(Eigen::Translation3d(2.5, 0.5, 0))));
    for (const double step : {1e-3, 1e-2}) {
        FlowParameters p = on_mesh(step, 3);
        p.tolerance = 0.3;
        const Evolved after = evolve_copy(mesh, p);
        ASSERT_EQ(after.report.steps.size(), 3U);
        for (const std::size_t begin : {std::size_t{0}, count}) {
            Eigen::AlignedBox3d box;
            for (const auto& at : vertices_from(mesh, begin, count).positions) box.extend(at);
            for (const auto& at : vertices_from(after.mesh, begin, count).positions) {
                EXPECT_LE(box.exteriorDistance(at), 1e-14);
            }
        }
    }
}

// The flow makes needles thicker (triangle_elements.h), so a step can make a surface of needles
// larger.
TEST(MeshFlow, UndoesAStepThatMakesTheSurfaceLargerAndEnds) {
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        // The length and the relative step size decide whether the first step or a later one fails.
        for (const auto& [frequency, length, step_size] :
             {std::tuple(3, 1e6, 1e-3), std::tuple(4, 1e4, 1e-4)}) {
            if (flow == FlowKind::Conformalized && frequency == 4) continue;
            const TriangleMesh mesh = with_spikes(shapes::geodesic_sphere(frequency), length);
            FlowParameters p = scaled_to(mesh, parameters(0, step_size, 6));
            p.flow = flow;
            const Evolved stopped = evolve_copy(mesh, p);
            EXPECT_EQ(stopped.report.stop, Stop::Grew);
            const auto made = static_cast<int>(stopped.report.steps.size());
            EXPECT_EQ(made > 0, frequency == 4);
            EXPECT_LE(stopped.report.area_after, 1.001 * stopped.report.area_before);
            if (made == 0) {
                EXPECT_TRUE(same_bits(stopped.mesh, mesh));
                EXPECT_EQ(stopped.report.largest_displacement, 0);
                continue;
            }
            p.iterations = made;
            const Evolved until_then = evolve_copy(mesh, p);
            EXPECT_EQ(until_then.report.stop, Stop::None);
            EXPECT_TRUE(same_bits(stopped.mesh, until_then.mesh));
        }
    }
}

TEST(MeshFlow, CloseSheetsFlowAsAlone) {
    // A hundredth of an edge apart, with different noise, and in the same cells.
    const TriangleMesh sheet = noisy(shapes::square(20), 0.01);
    TriangleMesh other = shapes::transformed(shapes::inside_out(noisy(shapes::square(20), 0.02)),
                                             Eigen::Affine3d(Eigen::Translation3d(0, 0, 5e-4)));
    const std::size_t count = sheet.positions.size();
    FlowParameters p = on_mesh(3e-3, 3, 4);
    p.tolerance = 1e-8;
    const TriangleMesh both = evolved(shapes::merged(sheet, other), p);
    EXPECT_LT(distance(vertices_from(both, 0, count), evolved(sheet, p)), 1e-7);
    EXPECT_LT(distance(vertices_from(both, count, count), evolved(other, p)), 1e-7);
    EXPECT_GT(distance(evolved(sheet, p), sheet), 0.01);
}

TEST(MeshFlow, OfATriangleSoupIsThatOfTheMesh) {
    for (const TriangleMesh& mesh : {noisy(shapes::bumpy_sphere(8), 0.01), book(5, {0, 1, 4})}) {
        for (const double step : {1e-3, 1e-1}) {
            const FlowParameters p = on_mesh(step, 3);
            const Evolved of_mesh = evolve_copy(mesh, p);
            const Evolved of_soup = evolve_copy(shapes::soup(mesh), p);
            EXPECT_EQ(of_soup.report.unknowns, of_mesh.report.unknowns);
            for (std::size_t i = 0; i < of_soup.mesh.positions.size(); ++i) {
                const std::int32_t vertex = mesh.triangles[i / 3][i % 3];
                EXPECT_LT((of_soup.mesh.positions[i] - of_mesh.mesh.positions[vertex]).norm(),
                          1e-12);
            }
        }
    }
}

// Where three pages meet at equal angles, their pulls on the axis are in balance.
TEST(MeshFlow, PagesMoveTheirCommonEdgeUnlessTheirPullsAreInBalance) {
    const double third = 2 * std::acos(-1.0) / 3;
    const TriangleMesh balanced = book(8, {0, third, 2 * third});
    EXPECT_LT(distance(evolved(balanced, on_mesh(1e-2, 3)), balanced), 1e-6);

    const TriangleMesh bent = book(8, {0, third});
    const TriangleMesh after = evolved(bent, on_mesh(1e-2, 3));
    const Eigen::Vector3d moved = after.positions[4] - bent.positions[4];
    // Between the pages.
    EXPECT_GT(moved[0], 0.03);
    EXPECT_NEAR(moved[1], moved[0] * std::tan(third / 2), 1e-3 * moved[0]);
}

TEST(MeshFlow, TakesAnOctreeOnceSolvesAreLong) {
    // Long triangles at the rim of a lens need more iterations than others.
    const TriangleMesh lens = shapes::transformed(shapes::bumpy_sphere(30),
                                                  Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 0.1)));
    FlowParameters p;
    p.step_size = 6 * std::pow(mean_edge_length(lens), 2);  // a step halves waves of 15 edges
    p.iterations = 2;
    TriangleMesh usual = lens, close = lens;
    EXPECT_EQ(evolve(usual, p).depth, 0);
    p.tolerance = 1e-12;
    const FlowReport report = evolve(close, p);
    ASSERT_EQ(report.steps.size(), 2U);
    EXPECT_GT(report.steps[0].solver_iterations, 2 * 30);
    EXPECT_GT(report.depth, 0);
}

// On the surface that noise leaves, the functions of the noisy one would be rough.
TEST(MeshFlow, SolvesAreShorterOnceNoiseIsGone) {
    TriangleMesh mesh = shapes::geodesic_sphere(40);
    const double edge = mean_edge_length(mesh);
    mesh = noisy(std::move(mesh), 0.8 * edge);
    FlowParameters p;
    p.detail_size = 80 * edge;
    const FlowReport report = evolve(mesh, p);
    ASSERT_EQ(report.steps.size(), 3U);
    for (const int i : {1, 2}) {
        EXPECT_LT(report.steps[i].solver_iterations, 0.8 * report.steps[0].solver_iterations);
    }
}

TEST(MeshFlow, HasNoOctreeForPartsOfAFewVertices) {
    TriangleMesh mesh = shapes::separate_triangles(50);
    FlowParameters p;
    p.boundary = BoundaryCondition::Free;
    p.detail_size = 1.5 * longest_side(mesh);
    ASSERT_GT(p.detail_size, 100 * mean_edge_length(mesh));
    EXPECT_EQ(evolve(mesh, p).depth, 0);
}

Eigen::Vector3d middle_of(const TriangleMesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = corners_of(mesh.positions, mesh.triangles[triangle]);
    return (a + b + c) / 3;
}

TEST(MeshFlow, IsThatOfAPartAloneHoweverManyLooseTrianglesThereAre) {
    const TriangleMesh cap = noisy(bumpy_cap(20), 0.005);
    const Eigen::Affine3d inside(Eigen::Translation3d(-0.5, -0.5, -0.5));
    const TriangleMesh loose = shapes::transformed(shapes::separate_triangles(300), inside);
    FlowParameters p = on_mesh(3e-3, 3);
    p.tolerance = 1e-7;
    p.boundary = BoundaryCondition::Free;
    const Evolved alone = evolve_copy(cap, p);
    TriangleMesh expected;
    for (const int threads : {1, 2, 3, 8}) {
        p.threads = threads;
        const Evolved all = evolve_copy(shapes::merged(cap, loose), p);
        EXPECT_EQ(all.report.stop, Stop::None);
        const TriangleMesh of_cap = vertices_from(all.mesh, 0, cap.positions.size());
        EXPECT_LT(distance(of_cap, alone.mesh), 1e-6);
        for (std::size_t i = 0; i < loose.triangles.size(); ++i) {
            const std::size_t triangle = cap.triangles.size() + i;
            EXPECT_LT((middle_of(all.mesh, triangle) - middle_of(loose, i)).norm(), 1e-3);
        }
        if (threads == 1) expected = all.mesh;
        EXPECT_TRUE(same_bits(all.mesh, expected)) << threads;
    }
    EXPECT_GT(distance(alone.mesh, cap), 0.01);
}

TEST(MeshFlow, ALooseToleranceIsNoFailure) {
    TriangleMesh mesh = shapes::bumpy_sphere(20);
    FlowParameters p;
    p.tolerance = 0.9;
    EXPECT_EQ(evolve(mesh, p).stop, Stop::None);
}

}  // namespace
}  // namespace tracked_mcf
