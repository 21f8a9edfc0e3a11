// SPDX-License-Identifier: GPL-3.0-or-later
/// OBJ to OBJ: only positions and normals change.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

TriangleMesh read_obj(const std::string& content) {
    const TemporaryFolder folder;
    write_file(folder / "in.obj", content);
    return MeshFile(folder / "in.obj").triangle_mesh();
}

TEST(Obj, EverythingButPositionsStaysToTheLetter) {
    const std::string content =
        "# made by hand\r\n"
        "mtllib two words \xE4.mtl\n"
        "o thing\n"
        "v  1.50 0 0 1 0 0\n"
        "v\t0 1 0   0 1 0\n"
        "v 0 -1e-3 0 0 0 1\n"
        "v 0.25 0 1 1 1 1 # a remark\n"
        "vt 0.1 0.2\nvt 0.3 0.4 0\nvt .5 .6\n\n"
        "g left right\nusemtl red\ns 1\n"
        "f 1/1 2/2 3/3\n"
        "f 1/3 -1/-1 2/2 3/1\n"
        "usemtl blue\nf 4 2 1\nl 1 2 3\n"
        "# the end";
    std::string expected = content;
    expected.replace(expected.find("1.50"), 4, "3");
    expected.replace(expected.find("0.25"), 4, "0.5");
    EXPECT_EQ(written_with_x_doubled(content, "obj"), expected);
}

TEST(Obj, DigitsOfDoublesAreReadAndWritten) {
    const double tiny = 1.2345678901234567e-9, far = 6000000.123456789;
    const std::string content =
        "v 1.2345678901234567e-9 0 0\nv 6000000.123456789 1 0\nv 0 1 0\nf 1 2 3\n";
    const TriangleMesh mesh = read_obj(content);
    EXPECT_EQ(mesh.positions[0].x(), tiny);
    EXPECT_EQ(mesh.positions[1].x(), far);
    const TriangleMesh doubled = read_obj(written_with_x_doubled(content, "obj"));
    EXPECT_EQ(doubled.positions[0].x(), 2 * tiny);
    EXPECT_EQ(doubled.positions[1].x(), 2 * far);
}

TEST(Obj, NormalsOfMovedFacesAreThoseOfTheNewShapeAndCreasesStaySharp) {
    // Two faces at a right angle share the edge 1 3. Each corner's normal is its face's own, but
    // for the third vn, which both use, and one that nobody uses. The second face does not move.
    const std::string content =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        "vn 9 9 9\nvn 9 9 9\nvn 9 9 9\nvn 0 0.6 0.8\n"
        "f 1//1 2//1 3//3\nf 1//2 3//3 4//2\n";
    const std::string written = written_with_x_doubled(content, "obj");
    const std::string begin = "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvn 9 9 9\nvn 0.44721";
    EXPECT_EQ(written.substr(0, begin.size()), begin);
    EXPECT_NE(written.find(" 0 0.894427190"), std::string::npos);
    EXPECT_NE(written.find("\nvn 0 0.6 0.8\nf 1//1 2//1 3//3\n"), std::string::npos);
}

}  // namespace
}  // namespace tracked_mcf
