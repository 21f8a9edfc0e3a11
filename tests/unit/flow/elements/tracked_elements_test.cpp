// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/weld.h"

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/elements.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TrackedElements build(const TriangleMesh& mesh, int depth) {
    return build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints);
}

/// Sum of the samples' weights, mesh units squared.
double sampled_area(const TrackedElements& elements) {
    double area = 0;
    for (std::int64_t sample = 0; sample < elements.samples.size(); ++sample) {
        area += elements.samples.weight(sample);
    }
    return area * elements.grid.cell_size * elements.grid.cell_size;
}

void expect_area_kept(const TriangleMesh& mesh, const TrackedElements& elements) {
    // Weights are single precision.
    EXPECT_NEAR(sampled_area(elements), surface_area(mesh), 1e-6 * surface_area(mesh));
}

TEST(TrackedElements, SampleWeightsSumToTheArea) {
    for (const TriangleMesh& mesh : {shapes::bumpy_sphere(12), shapes::torus(20, 12, 1, 0.4),
                                     shapes::square(3), shapes::box(2, {1, 2, 3})}) {
        for (const int depth : {1, 3, 6}) expect_area_kept(mesh, build(mesh, depth));
    }
}

TEST(TrackedElements, BoxWhoseFacesLieInGridPlanes) {
    const TriangleMesh mesh = shapes::box(4, {1, 1, 1});
    const Grid grid{Eigen::Vector3d::Constant(-0.5), 0.125, 4};  // every vertex is a grid corner
    const TrackedElements elements = build_tracked_elements(mesh, grid, Cubature::ThreePoints);
    expect_area_kept(mesh, elements);
    // Cells 4 to 11 are inside the box. Its three lower faces occupy the first layer inside, its
    // three upper faces the layer above the last. Each face occupies 8 by 8 cells. The plates of
    // the lower faces overlap in three rows and a corner, those of the upper faces nowhere.
    EXPECT_EQ(elements.finest().element_count(), (3 * 64 - 3 * 8 + 1) + 3 * 64);
}

TEST(TrackedElements, SamplesLieInTheirCells) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    const TrackedElements elements = build(mesh, 5);
    for (std::int64_t sample = 0; sample < elements.samples.size(); ++sample) {
        EXPECT_GE(elements.samples.local(sample).minCoeff(), 0);
        EXPECT_LE(elements.samples.local(sample).maxCoeff(), 1);
        EXPECT_GE(elements.samples.weight(sample), 0);
    }
}

TEST(TrackedElements, TheIdentityReproducesEveryVertex) {
    const TriangleMesh mesh = shapes::transformed(
        shapes::bumpy_sphere(15), Eigen::Translation3d(100, -50, 7) * Eigen::Scaling(3.0));
    const TrackedElements elements = build(mesh, 6);
    const Coefficients identity = identity_coefficients(elements);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3d in_grid = evaluate_vertex(elements, identity, elements.vertices[i]);
        const Eigen::Vector3d position = elements.grid.origin + elements.grid.cell_size * in_grid;
        EXPECT_LT((position - mesh.positions[i]).norm(), 1e-12 * longest_side(mesh));
    }
}

TEST(TrackedElements, UnreferencedVerticesHaveNoElement) {
    TriangleMesh mesh = shapes::geodesic_sphere(4);
    mesh.positions.emplace_back(1000, 0, 0);
    const TrackedElements elements = build(mesh, 4);
    EXPECT_EQ(elements.vertices.back().element, VertexLocation::kNoElement);
}

TEST(TrackedElements, CoincidentVerticesShareTheirLocation) {
    const TriangleMesh soup = shapes::soup(shapes::geodesic_sphere(5));
    const std::vector<std::int32_t> welded =
        weld_coincident_vertices(soup, referenced_vertices(soup));
    const TrackedElements elements = build(soup, 4);
    for (std::size_t i = 0; i < welded.size(); ++i) {
        EXPECT_EQ(elements.vertices[i].element, elements.vertices[welded[i]].element);
        EXPECT_EQ(elements.vertices[i].local, elements.vertices[welded[i]].local);
    }
}

TEST(TrackedElements, VerticesOfDegenerateTrianglesHaveALocation) {
    TriangleMesh mesh = shapes::geodesic_sphere(4);
    const auto extra = static_cast<std::int32_t>(mesh.positions.size());
    // A needle inside the sphere. A triangle with two equal vertices is none.
    for (const double x : {0.0, 0.25, 0.5, 0.75}) mesh.positions.emplace_back(x, 0, 0);
    mesh.triangles.push_back({extra, extra + 1, extra + 3});
    mesh.triangles.push_back({0, extra + 2, extra + 2});
    const TrackedElements elements = build(mesh, 5);
    EXPECT_NE(elements.vertices[extra].element, VertexLocation::kNoElement);
    EXPECT_NE(elements.vertices[extra + 1].element, VertexLocation::kNoElement);
    EXPECT_EQ(elements.vertices[extra + 2].element, VertexLocation::kNoElement);
    expect_area_kept(mesh, elements);
}

TEST(TrackedElements, IfAllTrianglesAreDegenerateItIsAnError) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {0, 0, 3}};
    EXPECT_THROW(build(mesh, 3), InvalidMesh);
    // Triangles that do not show beside the distance between them.
    mesh.positions = {{0, 0, 0}, {1e-12, 0, 0},     {0, 1e-12, 0},
                      {1, 1, 1}, {1, 1, 1 + 1e-12}, {1, 1 + 1e-12, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_THROW(build(mesh, 3), InvalidMesh);
}

TEST(TrackedElements, AMeshOutsideTheGridIsAnError) {
    const TriangleMesh mesh = shapes::square(2);
    const Grid grid{Eigen::Vector3d(0.5, 0, 0), 0.25, 3};
    EXPECT_THROW(build_tracked_elements(mesh, grid, Cubature::ThreePoints), InvalidMesh);
}

TEST(TrackedElements, ElementsThatMeetTheBoundaryAreMarked) {
    // The unit square covers 8 x 8 cells; the outer ones meet the boundary.
    const TriangleMesh mesh = shapes::square(5);
    const Grid grid{Eigen::Vector3d(0, 0, -0.4), 0.125, 3};
    const TrackedElements elements = build_tracked_elements(mesh, grid, Cubature::ThreePoints);
    ASSERT_EQ(elements.finest().element_count(), 64);
    for (std::int32_t element = 0; element < 64; ++element) {
        const Cell cell = cell_at(elements.finest().cells[element]);
        const bool outer = cell[0] == 0 || cell[0] == 7 || cell[1] == 0 || cell[1] == 7;
        EXPECT_EQ(elements.meets_held_side[element], outer ? 1 : 0);
    }
}

}  // namespace
}  // namespace tracked_mcf
