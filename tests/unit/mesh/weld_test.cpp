// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/weld.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

std::vector<std::int32_t> welded_vertices(const TriangleMesh& mesh) {
    return weld_coincident_vertices(mesh, referenced_vertices(mesh));
}

TEST(Weld, ASoupWeldsToItsMesh) {
    const TriangleMesh mesh = shapes::geodesic_sphere(3);
    const TriangleMesh soup = shapes::soup(mesh);
    const std::vector<std::int32_t> welded = welded_vertices(soup);
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
    EXPECT_EQ(welded_vertices(mesh)[3], 0);
}

TEST(Weld, UnreferencedVerticesStayAlone) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    mesh.triangles = {{1, 2, 3}};
    EXPECT_EQ(referenced_vertices(mesh), (std::vector<std::uint8_t>{0, 1, 1, 1, 0}));
    EXPECT_EQ(welded_vertices(mesh), (std::vector<std::int32_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace tracked_mcf
