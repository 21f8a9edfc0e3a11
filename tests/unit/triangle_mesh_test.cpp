// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <gtest/gtest.h>

#include <locale>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/core/plain_text.h"
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

/// A locale that writes a million as 1.000.000,0.
struct Grouping : std::numpunct<char> {
    char do_thousands_sep() const override { return '.'; }
    char do_decimal_point() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(PlainText, WritesTheSameNumbersInAnyLocale) {
    const std::locale usual =
        std::locale::global(std::locale(std::locale::classic(), new Grouping));
    PlainText text(3);
    text << 2000000 << ' ' << 0.125;
    std::string problem;
    try {
        check_range("iterations", 2e6, {1, 1e6, ""});
    } catch (const InvalidParameter& error) {
        problem = error.problem;
    }
    std::locale::global(usual);
    EXPECT_EQ(text.str(), "2000000 0.125");
    EXPECT_EQ(plain(1.0000001, 10), "1.0000001");
    EXPECT_EQ(problem, "is 2000000; give 1 to 1000000.");
}

TEST(CheckSize, RefusesMoreThan32BitsCount) {
    EXPECT_NO_THROW(check_size(2147483647, 1431655765));
    EXPECT_THROW(check_size(2147483648, 1), InvalidMesh);
    EXPECT_THROW(check_size(3, 1431655766), InvalidMesh);
}

}  // namespace
}  // namespace tracked_mcf
