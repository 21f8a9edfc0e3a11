// SPDX-License-Identifier: GPL-3.0-or-later
/// OFF to OFF: only positions and normals change.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"
#include "tests/support/measures.h"

namespace tracked_mcf {
namespace {

TEST(Off, PolygonsColoursAndCommentsStayToTheLetter) {
    const std::string content =
        "OFF 5 3 0\n# a comment\n0 0 0\n1.50 0 0\n\n1 1 0\n0 1 0\n0.5 0.5 1e-3\n"
        "4 0 1 2 3 255 0 0\n3  0 1 4 0.5 0.5 0.5 1.0\n3 1 2 4 7\n# the end\n";
    std::string expected = content;
    expected.replace(expected.find("1.50"), 4, "3");
    expected.replace(expected.find("1 1 0"), 1, "2");
    expected.replace(expected.find("0.5 0.5 1e-3"), 12, "1 0.5 1e-3");
    EXPECT_EQ(written_with_x_doubled(content, "off"), expected);
}

TEST(Off, AttributesOfVerticesStayAndNormalsAreThoseOfTheNewShape) {
    EXPECT_EQ(written_with_x_doubled("STCNOFF\n3 1 0\n"
                                     "0 0 0 9 9 9 255 0 0 0.5 0.25\n"
                                     "1 0 0 9 9 9 0 255 0 1 0\n"
                                     "0 1 0 9 9 9 0 0 255 0 1\n3 0 1 2\n",
                                     "off"),
              "STCNOFF\n3 1 0\n"
              "0 0 0 0 0 1 255 0 0 0.5 0.25\n"
              "2 0 0 0 0 1 0 255 0 1 0\n"
              "0 1 0 0 0 1 0 0 255 0 1\n3 0 1 2\n");
}

TEST(Off, QuadranglesAndPentagonsBecomeTriangles) {
    const TemporaryFolder folder;
    write_file(folder / "in.off",
               "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 0.5 0\n4 0 1 2 3\n5 0 1 2 3 4\n");
    const TriangleMesh mesh = MeshFile(folder / "in.off").triangle_mesh();
    EXPECT_EQ(mesh.triangles.size(), 5u);
    EXPECT_DOUBLE_EQ(surface_area(mesh), 1 + 1.5);
}

}  // namespace
}  // namespace tracked_mcf
