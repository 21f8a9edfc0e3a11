#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

int count_boundary(const TriangleMesh& mesh) {
    int count = 0;
    for (const std::uint8_t mask : boundary_edges(topology_of(mesh))) {
        for (int edge = 0; edge < 3; ++edge) count += (mask >> edge) & 1;
    }
    return count;
}

TEST(Validate, AcceptsASphere) {
    EXPECT_NO_THROW(validate(shapes::geodesic_sphere(2)));
}

TEST(Validate, RejectsEmptyMeshes) {
    EXPECT_THROW(validate(TriangleMesh()), InvalidMesh);
    TriangleMesh points = shapes::geodesic_sphere(1);
    points.triangles.clear();
    EXPECT_THROW(validate(points), InvalidMesh);
}

TEST(Validate, RejectsIndicesOutOfRange) {
    for (const std::int32_t bad : {-1, 42}) {
        TriangleMesh mesh = shapes::geodesic_sphere(2);
        ASSERT_EQ(mesh.positions.size(), 42U);
        mesh.triangles[5][1] = bad;
        EXPECT_THROW(validate(mesh), InvalidMesh);
    }
}

TEST(Validate, RejectsCoordinatesThatAreNotFinite) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
        TriangleMesh mesh = shapes::geodesic_sphere(2);
        mesh.positions[17][2] = bad;
        EXPECT_THROW(validate(mesh), InvalidMesh);
    }
}

TEST(Validate, IgnoresVerticesThatNoTriangleUses) {
    TriangleMesh mesh = shapes::geodesic_sphere(2);
    mesh.positions.emplace_back(kNaN, 0, 0);
    EXPECT_NO_THROW(validate(mesh));
    EXPECT_EQ(referenced_vertices(mesh).back(), 0);
}

TEST(Weld, SoupWeldsToItsMesh) {
    const TriangleMesh mesh = shapes::geodesic_sphere(3);
    const TriangleMesh soup = shapes::soup(mesh);
    const std::vector<std::int32_t> welded = weld_coincident_vertices(soup);
    std::size_t classes = 0;
    for (std::size_t i = 0; i < welded.size(); ++i) {
        EXPECT_EQ(soup.positions[i], soup.positions[welded[i]]);
        EXPECT_LE(welded[i], static_cast<std::int32_t>(i));
        classes += welded[i] == static_cast<std::int32_t>(i) ? 1 : 0;
    }
    EXPECT_EQ(classes, mesh.positions.size());
}

TEST(Weld, NegativeZeroIsZero) {
    TriangleMesh mesh;
    mesh.positions = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 1, 2}};
    EXPECT_EQ(weld_coincident_vertices(mesh)[3], 0);
}

TEST(BoundaryEdges, OfClosedOpenAndLooseMeshes) {
    EXPECT_EQ(count_boundary(shapes::geodesic_sphere(3)), 0);
    EXPECT_EQ(count_boundary(shapes::square(5)), 20);
    EXPECT_EQ(count_boundary(shapes::soup(shapes::geodesic_sphere(3))), 0);
}

TEST(BoundaryEdges, OfAFinAndOfRepeatedIndices) {
    TriangleMesh mesh = shapes::geodesic_sphere(2);
    const Triangle base = mesh.triangles[0];
    mesh.positions.emplace_back(2, 2, 2);
    mesh.triangles.push_back(
        {base[0], base[1], 42});  // a fin on an edge: two of its sides are free
    EXPECT_EQ(count_boundary(mesh), 2);
    mesh.triangles.push_back({42, 42, base[0]});  // closes nothing
    EXPECT_EQ(count_boundary(mesh), 2);
}

TEST(BoundaryEdges, OfASheetWithTwoFacesAndOfItsWeldedRim) {
    TriangleMesh mesh = shapes::square(5);
    const std::vector<Triangle> front = mesh.triangles;
    for (const Triangle& t : front) mesh.triangles.push_back({t[0], t[2], t[1]});
    EXPECT_EQ(count_boundary(mesh), 2 * 20);
}

TEST(SurfaceArea, OfSquareAndBox) {
    EXPECT_NEAR(surface_area(shapes::square(7)), 1, 1e-14);
    EXPECT_NEAR(surface_area(shapes::box(3, {1, 2, 3})), 22, 1e-13);
}

TEST(Grid, CubeIsATenthLargerThanTheLongestSideAndCentred) {
    const TriangleMesh mesh = shapes::box(2, {1, 4, 2});
    const Grid grid = enclosing_grid(mesh, 3);
    EXPECT_DOUBLE_EQ(grid.cell_size, 4.4 / 8);
    EXPECT_LT((grid.to_grid({0.5, 2, 1}) - Eigen::Vector3d::Constant(4)).norm(), 1e-14);
}

TEST(Grid, IgnoresUnreferencedVertices) {
    TriangleMesh mesh = shapes::box(2, {1, 4, 2});
    mesh.positions.emplace_back(1000, 0, 0);
    EXPECT_DOUBLE_EQ(longest_side(mesh), 4);
}

TEST(Grid, RejectsMeshesWithoutExtentOrTooLarge) {
    TriangleMesh point = shapes::square(2);
    for (auto& position : point.positions) position = {1, 2, 3};
    EXPECT_THROW(enclosing_grid(point, 3), InvalidMesh);
    TriangleMesh huge = shapes::square(2);
    for (auto& position : huge.positions) position *= 1e300;
    EXPECT_THROW(enclosing_grid(huge, 3), InvalidMesh);
    for (auto& position : huge.positions)
        position = (position - Eigen::Vector3d(5e299, 0, 0)) * 1e9;
    EXPECT_THROW(enclosing_grid(huge, 3), InvalidMesh);
}

}  // namespace
}  // namespace tracked_mcf
