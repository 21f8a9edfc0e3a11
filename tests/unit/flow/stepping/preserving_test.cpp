// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/preserving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/mesh_system.h"

namespace tracked_mcf {
namespace {

/// The volume is restored to the rounding of doubles after every step: Newton's method stops at a
/// relative correction of 1e-13. The volumes' own sums lose a few digits more.
constexpr double kRestored = 1e-10;

/// Returns the volume_between() without signs, a measure of how much the surface moved.
double absolute_volume_between(const TriangleMesh& before, const TriangleMesh& after) {
    double sum = 0;
    for (const Triangle& t : before.triangles) {
        sum +=
            std::abs(swept_volume(corners_of(before.positions, t), corners_of(after.positions, t)));
    }
    return sum;
}

/// Returns the first or the second of two meshes of the same number of vertices that were merged.
TriangleMesh half_of(const TriangleMesh& mesh, int half) {
    TriangleMesh part{mesh.positions, {}};
    const auto middle = static_cast<std::int32_t>(mesh.positions.size() / 2);
    for (const Triangle& t : mesh.triangles) {
        if ((t[0] < middle) == (half == 0)) part.triangles.push_back(t);
    }
    return part;
}

TriangleMesh beside(const TriangleMesh& mesh, double scale) {
    const Eigen::Affine3d place =
        Eigen::Affine3d(Eigen::Translation3d(2.5, 0.3, -0.2)) * Eigen::Scaling(scale);
    return shapes::merged(mesh, shapes::transformed(mesh, place));
}

double area_of(const TriangleMesh& mesh) {
    return surface_area(mesh);
}

double volume_of(const TriangleMesh& mesh) {
    return enclosed_volume(mesh);
}

/// Expects both halves of a mesh to have the area or volume that they had before.
template <class Measure>
void expect_halves_kept(const Measure& measure, const TriangleMesh& before,
                        const TriangleMesh& after) {
    for (int half = 0; half < 2; ++half) {
        const double kept = measure(half_of(before, half));
        EXPECT_NEAR(measure(half_of(after, half)), kept, kRestored * std::abs(kept));
    }
}

TEST(Preserving, KeepsItOverFiftySteps) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        for (const auto& [preserve, measure] :
             {std::pair{Preserve::Area, &area_of}, {Preserve::Volume, &volume_of}}) {
            FlowParameters p = preserving(preserve, 1e-3, 50);
            p.flow = flow;
            EXPECT_NEAR(measure(evolved(mesh, p)), measure(mesh), kRestored * measure(mesh));
        }
    }
}

TEST(PreservingVolume, EndsBeforeAStepThatIsTooLargeForIt) {
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    TriangleMesh flowing = mesh;
    const FlowReport report = evolve(flowing, preserving(Preserve::Volume, 1, 10));
    EXPECT_EQ(report.stop, Stop::NotPreserved);
    EXPECT_EQ(report.steps.size(), 0U);
    EXPECT_EQ(flowing.positions, mesh.positions);
}

TEST(PreservingVolume, SpecksVanishAndTheRestIsKept) {
    // The step is far too large for the speck, whose volume no pressure restores.
    const TriangleMesh sphere = shapes::bumpy_sphere(12);
    const TriangleMesh mesh = beside(sphere, 0.01);
    TriangleMesh after = mesh;
    const FlowReport report = evolve(after, scaled_to(mesh, preserving(Preserve::Volume, 1e-3, 3)));
    EXPECT_EQ(report.stop, Stop::None);
    EXPECT_EQ(report.steps.size(), 3U);
    const double volume = volume_of(half_of(mesh, 0));
    EXPECT_NEAR(volume_of(half_of(after, 0)), volume, kRestored * volume);
    EXPECT_LT(volume_of(half_of(after, 1)), 1e-7 * volume);
    EXPECT_GT(distance(half_of(after, 0), half_of(mesh, 0)), 0.01);
}

TEST(Preserving, SphereStaysAsItIsUpToTheSquareOfItsEdges) {
    const Eigen::Affine3d shift(Eigen::Translation3d(5, -7, 11));
    for (const Preserve preserve : {Preserve::Volume, Preserve::Area}) {
        FlowParameters p = preserving(preserve, 1e-2, 50);
        p.tolerance = 1e-6;
        const auto moved = [&](int frequency) {
            const TriangleMesh sphere =
                shapes::transformed(shapes::geodesic_sphere(frequency), shift);
            return distance(evolved(sphere, p), sphere);
        };
        EXPECT_NEAR(std::log2(moved(10) / moved(20)), 2, 0.2);
    }
}

TEST(PreservingVolume, OfSpheresOfUnequalSizeKeepsEachInItsPlace) {
    // Without pressures of their own, the smaller one would vanish.
    const TriangleMesh spheres = beside(shapes::geodesic_sphere(16), 0.4);
    FlowParameters p = scaled_to(spheres, preserving(Preserve::Volume, 1e-3, 100));
    p.tolerance = 1e-5;
    const TriangleMesh after = evolved(spheres, p);
    expect_halves_kept(volume_of, spheres, after);
    const double radii[] = {1, 0.4};
    for (int half = 0; half < 2; ++half) {
        const TriangleMesh one = half_of(spheres, half), one_after = half_of(after, half);
        EXPECT_LT((shapes::surface_centroid(one_after) - shapes::surface_centroid(one)).norm(),
                  p.tolerance * radii[half]);
    }
}

TEST(PreservingVolume, OfCloseShellsKeepsEach) {
    // Both are in the same cells, and the inner one is turned inside out.
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    const TriangleMesh shells = shapes::merged(
        sphere,
        shapes::inside_out(shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.97)))));
    const TriangleMesh after = evolved(shells, preserving(Preserve::Volume, 1e-4, 10));
    expect_halves_kept(volume_of, shells, after);
    EXPECT_GT(distance(after, shells), 1e-3);
}

TEST(PreservingVolume, OfAnOpenSurfaceWithALockedRim) {
    const TriangleMesh cap = bumpy_cap(20);
    TriangleMesh after = cap;
    const FlowReport report = evolve(after, preserving(Preserve::Volume, 1e-3, 100));
    EXPECT_EQ(report.stop, Stop::None);
    EXPECT_LT(std::abs(volume_between(cap, after)), kRestored * bounding_box(cap).volume());
    EXPECT_NEAR(report.volume_change, volume_between(cap, after), 1e-14);  // rounding
    EXPECT_GT(absolute_volume_between(cap, after), 1e-2 * bounding_box(cap).volume());
    // Without preserving, the cap sinks.
    EXPECT_LT(volume_between(cap, evolved(cap, preserving(Preserve::None, 1e-3, 100))),
              -0.1 * bounding_box(cap).volume());
}

TEST(PreservingVolume, OfASurfaceWithAFreeRim) {
    const TriangleMesh cap = bumpy_cap(20);
    for (const int order : {1, 2}) {
        FlowParameters p = preserving(Preserve::Volume, 1e-4, 20);
        p.boundary = BoundaryCondition::Free;
        p.order = order;
        const TriangleMesh after = evolved(cap, p);
        EXPECT_LT(std::abs(volume_between(cap, after)), kRestored * bounding_box(cap).volume());
        EXPECT_GT(distance(after, cap), 1e-3);
    }
}

TEST(PreservingVolume, OfASelectionLeavesTheRest) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Selection top = above(mesh, 0.3);
    TriangleMesh after = mesh;
    evolve(after, top, preserving(Preserve::Volume, 1e-3, 100));
    const TriangleMesh part = part_of(mesh, top);
    EXPECT_LT(std::abs(volume_between(part, after)), kRestored * bounding_box(part).volume());
    EXPECT_GT(absolute_volume_between(part, after), 1e-2 * bounding_box(part).volume());
    for (std::size_t i = 0; i < top.size(); ++i) {
        if (top[i] != 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) {
            EXPECT_TRUE(same_bits(after.positions[vertex], mesh.positions[vertex]));
        }
    }
}

/// A mesh over the unit disk with a lopsided hump. Its rim is the unit circle, and its elements map
/// a square's to the disk.
TriangleMesh lopsided_hump(double height) {
    TriangleMesh mesh = shapes::square(40);
    for (Eigen::Vector3d& p : mesh.positions) {
        const double x = 2 * p[0] - 1, y = 2 * p[1] - 1;
        const double u = x * std::sqrt(1 - y * y / 2), v = y * std::sqrt(1 - x * x / 2);
        p = {u, v, height * (1 - u * u - v * v) * (1 + 0.6 * u)};
    }
    return mesh;
}

TEST(PreservingVolume, MakesAHumpOverACircleASphericalCap) {
    // A soap film over a circle that holds a volume has constant mean curvature: a cap of height H
    // with V = π H (3 + H²) / 6 over a unit circle.
    const TriangleMesh hump = lopsided_hump(0.6);
    TriangleMesh flat = hump;
    for (Eigen::Vector3d& p : flat.positions) p[2] = 0;
    const double volume = volume_between(flat, hump);
    const double pi = std::acos(-1.0);
    double height = 0.5;
    for (int i = 0; i < 20; ++i) {
        height -=
            (pi * height * (3 + height * height) / 6 - volume) / (pi * (1 + height * height) / 2);
    }
    const double radius = (1 + height * height) / (2 * height);
    const Eigen::Vector3d centre(0, 0, height - radius);

    const auto distance_from_cap = [&](const TriangleMesh& mesh) {
        double largest = 0;
        for (const Eigen::Vector3d& position : mesh.positions) {
            largest = std::max(largest, std::abs((position - centre).norm() - radius));
        }
        return largest;
    };
    FlowParameters p = parameters(6, 0.02, 60);
    p.preserve = Preserve::Volume;
    const TriangleMesh cap = evolved(hump, p);
    EXPECT_NEAR(volume_between(flat, cap), volume, kRestored * volume);
    // The square's edges are 1/20 of the radius, so that chords are up to 1/20² / 2 = 1.25e-3 away
    // from a surface of curvature radius 1 or more. The grid's cells are smaller.
    EXPECT_LT(distance_from_cap(cap), 1.25e-3);
    EXPECT_GT(distance_from_cap(hump), 0.05);
}

TEST(PreservingVolume, MovesWithThePressureOfTheSameStep) {
    // The step without preserving and the restored step differ by one factor times the pressure's
    // response.
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    FlowParameters p = preserving(Preserve::Volume, 1e-3, 1);
    p.tolerance = 1e-8;
    TriangleMesh restored = mesh, plain = mesh;
    const double step_size = evolve(restored, p).step_size;
    p.preserve = Preserve::None;
    evolve(plain, p);

    const Surface surface = surface_of(mesh);
    MeshSolver solver(surface.stars, surface.held, surface.parts);
    solver.take(elements_of(surface), step_size / (surface.edge * surface.edge), true);
    Field pull;
    Preserver(surface, mesh, surface.positions, Preserve::Volume, FlowKind::MeanCurvature)
        .pressure(surface.positions, pull);
    std::vector<Eigen::Vector3d> response;
    solver.solve(pull, p.tolerance, response);
    Eigen::MatrixXd difference(mesh.positions.size(), 3), expected = difference;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        difference.row(row) = restored.positions[i] - plain.positions[i];
        expected.row(row) = response[static_cast<std::size_t>(surface.vertices[i])];
    }
    const double factor = difference.cwiseProduct(expected).sum() / expected.squaredNorm();
    EXPECT_GT(factor, 0);
    EXPECT_LT((difference - factor * expected).norm(), 1e-5 * difference.norm());
}

TEST(PreservingVolume, TurningASurfaceInsideOutChangesNothing) {
    // The order of the corners changes rounding and, within its tolerance, the solver's result.
    for (const TriangleMesh& mesh : {shapes::bumpy_sphere(15), bumpy_cap(15)}) {
        const FlowParameters p = preserving(Preserve::Volume);
        const TriangleMesh expected = evolved(mesh, p);
        const double moved = distance(expected, mesh);
        EXPECT_LT(distance(evolved(shapes::inside_out(mesh), p), expected), p.tolerance * moved);
        EXPECT_GT(moved, 1e-3);
    }
}

TEST(Preserving, HasTheSameBitsForAnyNumberOfThreads) {
    const TriangleMesh closed = beside(shapes::bumpy_sphere(30), 0.5);
    const TriangleMesh open = bumpy_cap(40);
    const auto expect_same = [](const TriangleMesh& mesh, const Selection& selection,
                                FlowParameters p) {
        TriangleMesh one = mesh;
        p.threads = 1;
        evolve(one, selection, p);
        EXPECT_FALSE(same_bits(one, mesh));
        for (const int threads : {2, 3}) {
            TriangleMesh more = mesh;
            p.threads = threads;
            evolve(more, selection, p);
            EXPECT_TRUE(same_bits(more, one)) << threads;
        }
    };
    FlowParameters p = parameters(6, 1e-4, 3);
    for (const Preserve preserve : {Preserve::Volume, Preserve::Area}) {
        p.preserve = preserve;
        for (p.order = 1; p.order <= 2; ++p.order) expect_same(closed, {}, p);
    }
    p.preserve = Preserve::Volume;
    expect_same(open, {}, p);
    expect_same(closed, above(closed, 0.2), p);
}

TEST(Preserving, ByScalingIsAStepThenAScaling) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const TriangleMesh plain = evolved(mesh, parameters(5, 1e-3, 1));
    const Eigen::Vector3d centre = shapes::surface_centroid(plain);
    const auto scaled = [&](double factor) {
        TriangleMesh result = plain;
        for (auto& p : result.positions) p = centre + factor * (p - centre);
        return result;
    };
    EXPECT_LT(distance(evolved(mesh, preserving(Preserve::Area, 1e-3, 1)),
                       scaled(std::sqrt(surface_area(mesh) / surface_area(plain)))),
              1e-12);
    FlowParameters p = preserving(Preserve::Volume, 1e-3, 1);
    p.flow = FlowKind::Conformalized;
    EXPECT_LT(distance(evolved(mesh, p),
                       scaled(std::cbrt(enclosed_volume(mesh) / enclosed_volume(plain)))),
              p.tolerance * distance(plain, mesh));
}

TEST(PreservingArea, OfEachOrderTurnsAnEllipsoidIntoASphere) {
    // Up to the mesh's error, which falls with the square of its edges.
    for (int order = 1; order <= kMaximumOrder; ++order) {
        const auto error = [order](int frequency) {
            TriangleMesh mesh = shapes::geodesic_sphere(frequency);
            for (auto& p : mesh.positions) p = p.cwiseProduct(Eigen::Vector3d(1, 0.6, 0.4));
            FlowParameters p = preserving(Preserve::Area, 0.1, 40);
            p.flow = FlowKind::Conformalized;
            p.order = order;
            const TriangleMesh after = evolved(mesh, p);
            const Eigen::Vector3d centre = shapes::surface_centroid(after);
            const double radius = std::sqrt(surface_area(mesh) / (4 * std::acos(-1.0)));
            double worst = 0;
            for (const Eigen::Vector3d& position : after.positions) {
                worst = std::max(worst, std::abs((position - centre).norm() - radius));
            }
            return worst;
        };
        EXPECT_NEAR(std::log2(error(8) / error(16)), 2, 0.3) << order;
    }
}

TEST(PreservingArea, OfTwoComponentsKeepsEachAreaAndCentroid) {
    for (const int order : {1, 2}) {
        const TriangleMesh mesh = beside(shapes::bumpy_sphere(16), 0.4);
        FlowParameters p = scaled_to(mesh, preserving(Preserve::Area, 1e-4, 1));
        p.order = order;
        const TriangleMesh plain = evolved(mesh, [&] {
            FlowParameters unscaled = p;
            unscaled.preserve = Preserve::None;
            return unscaled;
        }());
        const TriangleMesh after = evolved(mesh, p);
        expect_halves_kept(area_of, mesh, after);
        for (int half = 0; half < 2; ++half) {
            // The scaling is about the centroid after the step.
            EXPECT_LT((shapes::surface_centroid(half_of(after, half)) -
                       shapes::surface_centroid(half_of(plain, half)))
                          .norm(),
                      kRestored);
        }
        EXPECT_GT(distance(after, mesh), 1e-3);
        p.iterations = 50;
        expect_halves_kept(area_of, mesh, evolved(mesh, p));
    }
}

TEST(PreservingArea, OfAFreeOpenSurface) {
    const TriangleMesh cap = bumpy_cap(20);
    FlowParameters p = preserving(Preserve::Area);
    p.boundary = BoundaryCondition::Free;
    const double area = surface_area(cap);
    EXPECT_NEAR(surface_area(evolved(cap, p)), area, kRestored * area);
}

TEST(PreservingArea, EndsBeforeAStripThatHasBecomeALineIsInflated) {
    // The step makes the strip a hundred times narrower, but hardly shorter.
    TriangleMesh strip =
        shapes::transformed(shapes::square(20), Eigen::Affine3d(Eigen::Scaling(1.0, 0.02, 1.0)));
    const TriangleMesh before = strip;
    FlowParameters p = preserving(Preserve::Area, 4e-3, 1);
    p.boundary = BoundaryCondition::Free;
    EXPECT_EQ(evolve(strip, p).stop, Stop::Pinched);
    EXPECT_TRUE(same_bits(strip, before));
}

TEST(Preserving, KeepsADumbbellWhoseBarPinchesToAThreadWithinBounds) {
    TriangleMesh dumbbell = shapes::geodesic_sphere(30);
    for (auto& p : dumbbell.positions) {
        const double waist = 0.1 + 0.9 * p[0] * p[0];
        p = Eigen::Vector3d(2 * p[0], waist * p[1], waist * p[2]);
    }
    for (const Preserve preserve : {Preserve::Area, Preserve::Volume}) {
        TriangleMesh after = dumbbell;
        const FlowReport report = evolve(after, preserving(preserve, 5e-3, 100));
        EXPECT_LE(longest_side(after), 4 * longest_side(dumbbell));
        EXPECT_GT(report.steps.size(), 2U);
        if (preserve == Preserve::Area) {
            // Nothing holds the halves together then.
            EXPECT_EQ(report.stop, Stop::Pinched);
            continue;
        }
        EXPECT_NEAR(volume_of(after), volume_of(dumbbell), kRestored * volume_of(dumbbell));
    }
}

TEST(PreservingVolume, VolumesThatCancelDoNotEnlargeTheMesh) {
    const TriangleMesh sphere = shapes::geodesic_sphere(10);
    const TriangleMesh both = shapes::merged(
        sphere, shapes::inside_out(shapes::transformed(
                    sphere, Eigen::Affine3d(Eigen::Translation3d(3, 0, 0)) * Eigen::Scaling(0.9))));
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        FlowParameters p = preserving(Preserve::Volume, 5e-3, 50);
        p.flow = flow;
        expect_halves_kept(volume_of, both, evolved(both, p));
    }
}

TEST(PreservingVolume, OfBodiesThatTouchInAnEdge) {
    // Two welded boxes share an edge. Four triangles have this edge, two in each direction.
    const TriangleMesh two =
        shapes::merged(shapes::box(2, {1, 1, 1}),
                       shapes::transformed(shapes::box(2, {1, 1, 1}),
                                           Eigen::Affine3d(Eigen::Translation3d(1, 1, 0))));
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        FlowParameters p = preserving(Preserve::Volume, 1e-4, 2);
        p.flow = flow;
        EXPECT_NEAR(enclosed_volume(evolved(two, p)), 2, kRestored);
    }
}

TEST(Preserving, IgnoresDegenerateTrianglesAndUnusedVertices) {
    // The last triangle's vertices are those of no other triangle.
    TriangleMesh mesh = shapes::bumpy_sphere(10);
    const double volume = enclosed_volume(mesh), area = surface_area(mesh);
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    for (const double x : {0.1, 0.2, 0.3}) mesh.positions.emplace_back(x, 0, 0);
    mesh.positions.emplace_back(0, 0, 0);
    mesh.triangles.push_back({first, first + 1, first + 2});
    FlowParameters p = preserving(Preserve::Volume);
    EXPECT_NEAR(enclosed_volume(evolved(mesh, p)), volume, kRestored * volume);
    p = preserving(Preserve::Area);
    p.boundary = BoundaryCondition::Free;
    EXPECT_NEAR(surface_area(evolved(mesh, p)), area, kRestored * area);
}

}  // namespace
}  // namespace tracked_mcf
