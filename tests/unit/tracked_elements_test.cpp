#include "filter_tracked_mcf/core/tracked_elements.h"

#include <gtest/gtest.h>

#include <numeric>

#include "filter_tracked_mcf/core/automatic_depth.h"
#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/errors.h"
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

TEST(TrackedElements, SampleWeightsAddUpToTheArea) {
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
    // Cells 4 to 11 are inside. The lower faces lie in the first layer inside, the upper ones in
    // the layer above the last, so two shells of three 8 by 8 plates each; plates of the lower
    // shell overlap in three rows and a corner, those of the upper one lie apart from all others.
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

TEST(TrackedElements, IdentityCoefficientsReproduceEveryVertex) {
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

TEST(TrackedElements, UnreferencedVerticesAreNowhere) {
    TriangleMesh mesh = shapes::geodesic_sphere(4);
    mesh.positions.emplace_back(1000, 0, 0);
    const TrackedElements elements = build(mesh, 4);
    EXPECT_EQ(elements.vertices.back().element, VertexPlace::kNowhere);
    EXPECT_EQ(elements.referenced_vertex_count, 162);
}

TEST(TrackedElements, CoincidentVerticesShareTheirPlace) {
    const TriangleMesh soup = shapes::soup(shapes::geodesic_sphere(5));
    const std::vector<std::int32_t> welded = weld_coincident_vertices(soup);
    const TrackedElements elements = build(soup, 4);
    for (std::size_t i = 0; i < welded.size(); ++i) {
        EXPECT_EQ(elements.vertices[i].element, elements.vertices[welded[i]].element);
        EXPECT_EQ(elements.vertices[i].local, elements.vertices[welded[i]].local);
    }
}

TEST(TrackedElements, VerticesOfDegenerateTrianglesHaveAPlace) {
    TriangleMesh mesh = shapes::geodesic_sphere(4);
    const auto extra = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, 0);  // far from the sphere, at the end of a needle
    mesh.triangles.push_back({0, extra, extra});
    const TrackedElements elements = build(mesh, 5);
    EXPECT_EQ(elements.degenerate_triangle_count, 1);
    EXPECT_NE(elements.vertices[extra].element, VertexPlace::kNowhere);
    expect_area_kept(mesh, elements);
}

TEST(TrackedElements, AllTrianglesDegenerateIsAnError) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {0, 0, 3}};
    EXPECT_THROW(build(mesh, 3), InvalidMesh);
}

TEST(TrackedElements, MeshOutsideTheGridIsAnError) {
    const TriangleMesh mesh = shapes::square(2);
    const Grid grid{Eigen::Vector3d(0.5, 0, 0), 0.25, 3};
    EXPECT_THROW(build_tracked_elements(mesh, grid, Cubature::ThreePoints), InvalidMesh);
}

TEST(TrackedElements, BoundaryIsMarkedWhereItsEdgesPass) {
    // The unit square on a grid of 8 cells a side: a frame of cells around 6 x 6 inner ones.
    const TriangleMesh mesh = shapes::square(5);
    const Grid grid{Eigen::Vector3d(0, 0, -0.4), 0.125, 3};
    const TrackedElements elements = build_tracked_elements(mesh, grid, Cubature::ThreePoints);
    ASSERT_EQ(elements.finest().element_count(), 64);
    for (std::int32_t element = 0; element < 64; ++element) {
        const Cell cell = cell_at(elements.finest().cells[element]);
        const bool rim = cell[0] == 0 || cell[0] == 7 || cell[1] == 0 || cell[1] == 7;
        EXPECT_EQ(elements.held[element], rim ? 1 : 0);
    }
}

TEST(Octree, LevelsNestAndNumberTheirCornersAsElementsHaveThemFirst) {
    const TrackedElements elements = build(shapes::bumpy_sphere(10), 5);
    ASSERT_EQ(elements.levels.size(), 6U);
    EXPECT_EQ(elements.levels[0].element_count(), 1);
    EXPECT_EQ(elements.levels[0].unknown_count(), 8);
    for (std::size_t l = 1; l < elements.levels.size(); ++l) {
        const Level& fine = elements.levels[l];
        const Level& coarse = elements.levels[l - 1];
        std::vector<MortonCode> corners;  // of every unknown
        for (std::int32_t e = 0; e < fine.element_count(); ++e) {
            EXPECT_EQ(coarse.cells[fine.parents[e]], parent_of(fine.cells[e]));
            for (int corner = 0; corner < 8; ++corner) {
                const MortonCode code = morton_code(corner_of(cell_at(fine.cells[e]), corner));
                const auto unknown = static_cast<std::size_t>(fine.unknowns[e][corner]);
                ASSERT_LE(unknown, corners.size());
                if (unknown == corners.size()) corners.push_back(code);
                EXPECT_EQ(corners[unknown], code);
            }
        }
        EXPECT_EQ(corners.size(), static_cast<std::size_t>(fine.unknown_count()));
    }
}

TEST(AutomaticDepth, OfASoupIsThatOfItsMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    EXPECT_EQ(automatic_depth(shapes::soup(mesh)), automatic_depth(mesh));
}

TEST(AutomaticDepth, OfNeedlesAndOfNothingEndsSoon) {
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
            return std::abs(build(mesh, depth).finest().unknown_count() -
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

}  // namespace
}  // namespace tracked_mcf
