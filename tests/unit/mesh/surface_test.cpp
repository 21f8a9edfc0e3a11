// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// A mesh whose vertices and faces are in another order, and whose faces begin at other corners.
struct Shuffled {
    explicit Shuffled(const TriangleMesh& original, unsigned seed = 1)
        : vertices(original.positions.size()), faces(original.triangles.size()) {
        std::mt19937 random(seed);
        for (auto* const order : {&vertices, &faces}) {
            std::iota(order->begin(), order->end(), 0);
            std::shuffle(order->begin(), order->end(), random);
        }
        std::vector<std::int32_t> numbers(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            numbers[vertices[i]] = static_cast<std::int32_t>(i);
            mesh.positions.push_back(original.positions[vertices[i]]);
        }
        for (const std::int32_t face : faces) {
            Triangle t = original.triangles[face];
            std::rotate(t.begin(), t.begin() + random() % 3, t.end());
            mesh.triangles.push_back({numbers[t[0]], numbers[t[1]], numbers[t[2]]});
        }
    }

    /// Returns a selection or strengths of the original for this mesh.
    template <class Items>
    static Items in_order(const Items& items, const std::vector<std::int32_t>& order) {
        Items result(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) result[i] = items[order[i]];
        return result;
    }
    TriangleMesh restored(const TriangleMesh& original) const {
        TriangleMesh result = original;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            result.positions[vertices[i]] = mesh.positions[i];
        return result;
    }

    TriangleMesh mesh;
    std::vector<std::int32_t> vertices, faces;  ///< of the original
};

/// Meshes of one part and of several, closed and open, with vertices in one place, a surface with
/// one side, an edge of three triangles, and faces that look the wrong way.
std::vector<TriangleMesh> various_meshes() {
    TriangleMesh misoriented = shapes::torus(20, 12, 1, 0.4);
    for (std::size_t i = 0; i < misoriented.triangles.size(); i += 7)
        std::swap(misoriented.triangles[i][1], misoriented.triangles[i][2]);
    const TriangleMesh fin{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    return {shapes::bumpy_sphere(12),
            shapes::soup(bumpy_cap(10)),
            shapes::merged(misoriented, fin),
            shapes::merged(fin, shapes::stack(shapes::square(9), 3, 0.3)),
            shapes::moebius_band(20, 3),
            shapes::separate_triangles(50)};
}

/// The mesh with each face twice: the second copy looks the other way, or not.
TriangleMesh doubled(TriangleMesh mesh, bool both_ways) {
    const std::vector<Triangle> front = mesh.triangles;
    for (const Triangle& t : front)
        mesh.triangles.push_back(both_ways ? Triangle{t[0], t[2], t[1]} : t);
    return mesh;
}

TEST(Surface, DoesNotDependOnTheOrderOfTheFile) {
    for (const TriangleMesh& mesh : various_meshes()) {
        const Surface expected = surface_of(mesh);
        for (const unsigned seed : {1U, 2U}) {
            const Shuffled other(mesh, seed);
            const Surface surface = surface_of(other.mesh);
            EXPECT_EQ(surface.positions, expected.positions);
            EXPECT_TRUE(surface.stars.triangles == expected.stars.triangles);
            EXPECT_EQ(surface.parts, expected.parts);
            EXPECT_EQ(surface.edge, expected.edge);
            for (std::size_t i = 0; i < other.vertices.size(); ++i)
                EXPECT_EQ(surface.vertices[i], expected.vertices[other.vertices[i]]);
        }
    }
}

TEST(Surface, OfAllFiltersResultsHaveTheSameBitsInAnyOrder) {
    for (const TriangleMesh& clean : various_meshes()) {
        const TriangleMesh mesh =
            clean.positions.size() < 100 ? clean : with_isotropic_noise(clean, 0.1);
        const Shuffled shuffled(mesh);
        const auto expect_same = [&](const auto& filter) {
            TriangleMesh first = mesh;
            Shuffled second = shuffled;
            filter(first, [](const auto& items, const auto& /*order*/) { return items; });
            filter(second.mesh, [](const auto& items, const auto& order) {
                return Shuffled::in_order(items, order);
            });
            EXPECT_TRUE(same_bits(second.restored(mesh), first));
        };
        const Selection selection = above(mesh, 0.02);
        std::vector<double> strengths(mesh.positions.size());
        for (std::size_t i = 0; i < strengths.size(); ++i) {
            const Eigen::Vector3d& p = mesh.positions[i];
            strengths[i] = p.x() < 0.1 ? 0 : std::min(1.0, p.norm());
        }
        expect_same([&](TriangleMesh& m, const auto&) { evolve(m, FlowParameters()); });
        expect_same([&](TriangleMesh& m, const auto& in_order) {
            evolve(
                m,
                Inputs(in_order(selection, shuffled.faces), in_order(strengths, shuffled.vertices)),
                FlowParameters());
        });
        expect_same([&](TriangleMesh& m, const auto&) {
            FlowParameters paper;
            paper.method = Method::Paper;
            evolve(m, paper);
        });
        expect_same([&](TriangleMesh& m, const auto&) {
            NoiseParameters parameters;
            parameters.noise = 0.1 * mean_edge_length(clean);
            remove_noise(m, {}, parameters);
        });
        if (std::count(selection.begin(), selection.end(), 0) == 0) continue;
        expect_same([&](TriangleMesh& m, const auto& in_order) {
            const std::string held = "Nothing holds a part";
            try {
                fair(m, in_order(selection, shuffled.faces), {});
            } catch (const InvalidMesh& error) {
                EXPECT_EQ(error.what(), held + std::string(error.what()).substr(held.size()));
            }
        });
    }
}

TEST(Surface, ItsTrianglesAreSortedAndItsPartsFollowEachOther) {
    for (const TriangleMesh& mesh : various_meshes()) {
        const Surface surface = surface_of(mesh);
        EXPECT_TRUE(std::is_sorted(surface.parts.begin(), surface.parts.end()));
        EXPECT_EQ(surface.parts.back() + 1, surface.part_count);
        std::int32_t before = 0;
        for (const auto& [a, b, c] : surface.stars.triangles) {
            EXPECT_LT(a, std::min(b, c));
            EXPECT_LE(before, a);
            EXPECT_EQ(surface.parts[a], surface.parts[b]);
            EXPECT_EQ(surface.parts[a], surface.parts[c]);
            before = a;
        }
    }
    EXPECT_EQ(surface_of(shapes::stack(shapes::square(5), 3, 1)).part_count, 3);
    EXPECT_EQ(surface_of(shapes::separate_triangles(50)).part_count, 50);
}

TEST(Surface, LeadsBackToTheMesh) {
    const TriangleMesh mesh = shapes::soup(shapes::transformed(
        shapes::bumpy_sphere(6), Eigen::Translation3d(50, 0, 3) * Eigen::Scaling(7.0)));
    const Surface surface = surface_of(mesh);
    EXPECT_NEAR(surface.edge, mean_edge_length(mesh), 1e-12);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3d& at = surface.positions[surface.vertices[i]];
        EXPECT_LT((surface.edge * at + surface.box.center() - mesh.positions[i]).norm(), 1e-12);
    }
    for (std::int32_t vertex = 0; vertex < surface.stars.count(); ++vertex) {
        EXPECT_EQ(surface.vertices[surface.mesh_vertices[vertex]], vertex);
        EXPECT_EQ(surface.in_edges(mesh, vertex), surface.positions[vertex]);
    }
}

TEST(Surface, HasNoTrianglesWithTwoEqualVertices) {
    TriangleMesh mesh = shapes::geodesic_sphere(3);
    const auto count = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back(5, 5, 5);
    mesh.positions.push_back(mesh.positions[1]);
    mesh.triangles.push_back({0, count, count});      // by numbers
    mesh.triangles.push_back({1, count + 1, count});  // by places
    mesh.triangles.push_back({2, 2, 2});
    const Surface surface = surface_of(mesh);
    EXPECT_EQ(surface.stars.count(), count);
    EXPECT_EQ(surface.vertices[count], -1);
    EXPECT_EQ(surface.counts.degenerate, 3);
    EXPECT_EQ(surface.part_count, 1);
    EXPECT_FALSE(surface.stars.has_rim());
    EXPECT_EQ(surface.genus(), 0);
}

TEST(Surface, HasNoTrianglesWithTwoEqualVerticesWhateverIsSelected) {
    // A face with two vertices at one place, where no other face is.
    TriangleMesh mesh = shapes::square(6);
    const auto count = static_cast<std::int32_t>(mesh.positions.size());
    for (const double x : {5.0, 5.0, 6.0}) mesh.positions.emplace_back(x, 5, 5);
    mesh.triangles.push_back({count, count + 1, count + 2});
    Selection selection(mesh.triangles.size(), 1);
    selection[0] = 0;
    for (const Surface& surface : {surface_of(mesh, selection, BoundaryCondition::Locked),
                                   surface_of_selection(surface_of(mesh), mesh, selection)}) {
        EXPECT_EQ(surface.part_count, 1);
        EXPECT_EQ(surface.vertices.back(), -1);
        EXPECT_EQ(surface.counts.degenerate, 1);
        EXPECT_LE(surface.box.max().maxCoeff(), 1);
    }
    Selection middle(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < middle.size(); ++i) {
        const Eigen::Vector3d& p = mesh.positions[mesh.triangles[i][0]];
        middle[i] = p.x() > 0.2 && p.x() < 0.8 && p.y() > 0.2 && p.y() < 0.8 ? 1 : 0;
    }
    middle.back() = 1;
    EXPECT_EQ(fair(mesh, middle, {}).patches, 1);
}

TEST(Surface, IsInTheOrderOfSpaceBesideAFarVertex) {
    const TriangleMesh mesh = shapes::bumpy_sphere(30);
    TriangleMesh with_outlier = mesh;
    const auto count = static_cast<std::int32_t>(mesh.positions.size());
    for (const double x : {1e9, 1e9 + 1, 1e9 + 2}) with_outlier.positions.emplace_back(x, x, 0);
    with_outlier.positions.back().z() = 1;
    with_outlier.triangles.push_back({count, count + 1, count + 2});
    const Surface expected = surface_of(mesh), surface = surface_of(with_outlier);
    for (std::int32_t i = 0; i < count; ++i) EXPECT_EQ(surface.vertices[i], expected.vertices[i]);
    const Surface shuffled = surface_of(Shuffled(with_outlier).mesh);
    EXPECT_EQ(shuffled.positions, surface.positions);
}

TEST(Surface, RejectsMeshesWithoutExtentOrTooLarge) {
    TriangleMesh point = shapes::square(2);
    for (Eigen::Vector3d& p : point.positions) p = {1, 2, 3};
    EXPECT_THROW(surface_of(point, {}, BoundaryCondition::Free), InvalidMesh);
    EXPECT_EQ(surface_of(point).counts.degenerate, 8);
    TriangleMesh huge = shapes::square(2);
    for (Eigen::Vector3d& p : huge.positions) p *= 1e300;
    EXPECT_THROW(surface_of(huge), InvalidMesh);
    TriangleMesh far = shapes::square(2);
    for (Eigen::Vector3d& p : far.positions) p.x() += 1e13;
    EXPECT_THROW(surface_of(far), InvalidMesh);
    for (Eigen::Vector3d& p : huge.positions) p = (p - Eigen::Vector3d(5e299, 0, 0)) * 1e9;
    EXPECT_THROW(surface_of(huge), InvalidMesh);
}

TEST(Surface, IgnoresVerticesThatNoTriangleUses) {
    TriangleMesh mesh = shapes::box(2, {1, 4, 2});
    mesh.positions.emplace_back(1000, 0, 0);
    const Surface surface = surface_of(mesh);
    EXPECT_DOUBLE_EQ(surface.box.sizes().maxCoeff(), 4);
    EXPECT_EQ(surface.vertices.back(), -1);
}

TEST(Copies, CountOnceInEitherDirection) {
    for (const bool both_ways : {false, true}) {
        const TriangleMesh mesh = doubled(shapes::square(5), both_ways);
        const Surface surface = surface_of(mesh, {}, BoundaryCondition::Free);
        EXPECT_EQ(surface.stars.triangles.size(), 50U);
        EXPECT_EQ(surface.counts.copies, 50);
        EXPECT_EQ(surface.counts.boundary_edges, 20);
        EXPECT_EQ(surface.counts.double_sided_parts, both_ways ? 1 : 0);
        EXPECT_TRUE(surface.is_oriented_alike());
        EXPECT_EQ(surface.parts, surface_of(shapes::square(5)).parts);
    }
}

TEST(Copies, OfAClosedSurfaceLeaveItsVolume) {
    for (const bool both_ways : {false, true}) {
        const TriangleMesh mesh = doubled(shapes::geodesic_sphere(5), both_ways);
        const Surface surface = surface_of(mesh);
        EXPECT_TRUE(surface.bounds_volume());
        EXPECT_EQ(surface.genus(), 0);
    }
    // Most copies decide about the direction.
    TriangleMesh mesh = shapes::geodesic_sphere(5);
    const Surface plain = surface_of(mesh);
    const auto [a, b, c] = mesh.triangles[3];
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, a});
    EXPECT_TRUE(surface_of(mesh).stars.triangles == plain.stars.triangles);
    EXPECT_EQ(surface_of(mesh).counts.double_sided_parts, 0);
}

/// Expects that a filter moves a mesh and its doubled copies alike, up to a distance.
template <class Filter>
void expect_same_with_copies(const TriangleMesh& mesh, double tolerance, const Filter& filter) {
    TriangleMesh expected = mesh;
    filter(expected);
    EXPECT_FALSE(same_bits(expected, mesh));
    for (const bool both_ways : {false, true}) {
        TriangleMesh after = doubled(mesh, both_ways);
        filter(after);
        EXPECT_LE(distance(after, expected), both_ways ? tolerance : 0) << both_ways;
    }
}

TEST(Copies, ChangeNothingThatAFilterDoes) {
    for (const TriangleMesh& clean : {shapes::square(30), shapes::bumpy_sphere(20)}) {
        const TriangleMesh mesh = with_noise(clean, 0.2);
        expect_same_with_copies(mesh, 0, [](TriangleMesh& m) { evolve(m, FlowParameters()); });
        // An open surface may be seen from its other side.
        expect_same_with_copies(mesh, 1e-6 * mean_edge_length(clean), [](TriangleMesh& m) {
            EXPECT_EQ(remove_noise(m, {}, {}).stop, NoiseStop::None);
        });
        const Eigen::Vector3d middle = clean.positions[clean.positions.size() / 2];
        expect_same_with_copies(mesh, 1e-14, [&](TriangleMesh& m) {
            Selection disc;
            for (const Triangle& t : m.triangles)
                disc.push_back((m.positions[t[0]] - middle).norm() < 0.2 ? 1 : 0);
            EXPECT_EQ(fair(m, disc, {}).patches, 1);
        });
    }
}

TEST(Orientation, IsThatOfMostOfAPart) {
    TriangleMesh sphere = shapes::geodesic_sphere(4);
    const Surface expected = surface_of(sphere);
    for (std::size_t i = 0; i < sphere.triangles.size(); i += 3)
        std::swap(sphere.triangles[i][1], sphere.triangles[i][2]);
    const Surface surface = surface_of(sphere);
    EXPECT_TRUE(surface.stars.triangles == expected.stars.triangles);
    EXPECT_TRUE(surface.bounds_volume());
}

TEST(Orientation, OfASurfaceWithOneSideIsTold) {
    EXPECT_FALSE(surface_of(shapes::moebius_band(20, 3)).is_oriented_alike());
    EXPECT_TRUE(surface_of(shapes::tube(20, 3, 1)).is_oriented_alike());
}

TEST(Orientation, StaysWhereItIsConsistent) {
    // A sphere that looks outwards, and another one inside that looks inwards.
    const TriangleMesh sphere = shapes::geodesic_sphere(3);
    const TriangleMesh shell = shapes::merged(
        sphere,
        shapes::inside_out(shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.5)))));
    const Surface surface = surface_of(shell);
    EXPECT_NEAR(enclosed_volume({surface.in_mesh_units(shell),
                                 {surface.stars.triangles.begin(), surface.stars.triangles.end()}}),
                enclosed_volume(sphere) * 7 / 8, 1e-12);
    // Two boxes that share an edge: four triangles, two in each direction.
    const TriangleMesh boxes =
        shapes::merged(shapes::box(2, {1, 1, 1}),
                       shapes::transformed(shapes::box(2, {1, 1, 1}),
                                           Eigen::Affine3d(Eigen::Translation3d(1, 1, 0))));
    EXPECT_TRUE(surface_of(boxes).bounds_volume());
    EXPECT_EQ(surface_of(boxes).stars.most_triangles_of_edge, 4);
}

TEST(Genus, IsTheNumberOfHandlesOfAllParts) {
    const auto genus = [](const TriangleMesh& mesh) { return surface_of(mesh).genus(); };
    const TriangleMesh sphere = shapes::geodesic_sphere(3), torus = shapes::torus(12, 8, 3, 1);
    EXPECT_EQ(genus(sphere), 0);
    EXPECT_EQ(genus(torus), 1);
    EXPECT_EQ(genus(shapes::soup(torus)), 1);
    EXPECT_EQ(genus(shapes::merged(sphere, torus)), 1);
    EXPECT_EQ(
        genus(shapes::merged(
            torus, shapes::transformed(torus, Eigen::Affine3d(Eigen::Translation3d(9, 0, 0))))),
        2);
    TriangleMesh open = torus;
    open.triangles.pop_back();
    EXPECT_EQ(genus(open), 0);
}

}  // namespace
}  // namespace tracked_mcf
