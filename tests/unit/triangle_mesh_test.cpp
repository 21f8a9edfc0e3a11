// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/not_finite.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

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
}

TEST(CheckSize, RefusesMoreThan32BitsCount) {
    EXPECT_NO_THROW(check_size(2147483647, 1431655765));
    EXPECT_THROW(check_size(2147483648, 1), InvalidMesh);
    EXPECT_THROW(check_size(3, 1431655766), InvalidMesh);
}

}  // namespace
}  // namespace tracked_mcf
