// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/automatic_depth.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TrackedElements elements_at(const TriangleMesh& mesh, int depth) {
    return build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints);
}

TEST(AutomaticDepth, OfASoupIsThatOfItsMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    EXPECT_EQ(automatic_depth(shapes::soup(mesh)), automatic_depth(mesh));
}

TEST(AutomaticDepth, OfAStackIsThatOfItsSheet) {
    const TriangleMesh sheet = shapes::square(9);
    const TriangleMesh stack = shapes::stack(sheet, 50, 1e-6);
    EXPECT_EQ(automatic_depth(stack), automatic_depth(sheet));
    EXPECT_GT(automatic_depth(stack, false), automatic_depth(sheet));
}

TEST(AutomaticDepth, OfSeparateTrianglesDoesNotCountTheirSheets) {
    const TriangleMesh triangles = shapes::separate_triangles(5000);
    EXPECT_EQ(automatic_depth(triangles), automatic_depth(triangles, false));
}

TEST(AutomaticDepth, EndsForNeedlesAndIsOneForDegenerateTriangles) {
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
            return std::abs(elements_at(mesh, depth).finest().unknown_count() -
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
