// SPDX-License-Identifier: GPL-3.0-or-later
/// From another format to PLY or STL: geometry arrives, and a warning names the rest.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::IsEmpty;

/// Returns the bytes of `content`, in a file "in" with the extension `from`, in the format `to`.
std::string converted(const std::string& content, const std::string& from, const std::string& to) {
    const TemporaryFolder folder;
    write_file(folder / ("in." + from), content);
    const MeshFile file(folder / ("in." + from));
    return written(file, file.triangle_mesh(), "out." + to);
}

/// Digits that floats do not have, a quadrangle, colours, and texture coordinates with a seam.
const std::string kPly =
    "ply\nformat ascii 1.0\ncomment TextureFile skin.png\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float quality\n"
    "property int flags\nelement face 2\nproperty list uchar int vertex_indices\n"
    "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nend_header\n"
    "0 0 1e-9 255 0 0 0 0\n1.23456789012345 0 0 0 255 0 0 0\n1 1 0 0 0 255 0 0\n"
    "0 1 0 255 255 51 0 0\n4 0 1 2 3 8 0 0 1 0 0 1 1 1\n3 2 1 3 6 0.5 0.5 0.75 0.5 0.75 0.75\n0\n";

TEST(Conversion, ToPlyKeepsPositionsToTheLastDigitAndPolygons) {
    const std::string stray = "v 0 0 0\n";
    const std::string obj = "v 1.23456789012345 0 1e-9\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    EXPECT_EQ(converted(stray + obj + "f 2 3 4 5\nf 3 5 4\n", "obj", "ply"),
              "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty double x\n"
              "property double y\nproperty double z\nelement face 2\n"
              "property list uchar int vertex_indices\nend_header\n" +
                  packed(0., 0., 0., 1.23456789012345, 0., 1e-9, 1., 0., 0., 1., 1., 0.) +
                  packed(0., 1., 0.) + packed(std::uint8_t{4}, 1, 2, 3, 4) +
                  packed(std::uint8_t{3}, 2, 4, 3));
}

TEST(Conversion, ToPlyKeepsPolygonsOfMoreThan255Corners) {
    std::string off = "OFF\n300 1 0\n", face = "300";
    for (int i = 0; i < 300; ++i) {
        off += std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
        face += " " + std::to_string(i);
    }
    const TemporaryFolder folder;
    write_file(folder / "a.ply", converted(off + face + "\n", "off", "ply"));
    EXPECT_EQ(MeshFile(folder / "a.ply").triangle_mesh().triangles.size(), 298u);
}

TEST(Conversion, ToStlWritesFloatsAndNormals) {
    const std::string stl = converted("OFF\n3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n", "off", "stl");
    EXPECT_EQ(stl.substr(80), packed(1u, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 1.f, 0.f,
                                     std::uint16_t{0}));
    EXPECT_NE(stl.substr(0, 5), "solid") << "readers would take it for ASCII";
}

/// What the warning names as left out.
std::string left_out(const std::string& content, const std::string& from, const std::string& to) {
    const TemporaryFolder folder;
    write_file(folder / ("in." + from), content);
    std::string warning = MeshFile(folder / ("in." + from)).conversion_warning("out." + to);
    const std::string begin = "Left out: ", end = ". To keep it, write a ." + from + " file.";
    const std::size_t first = warning.find(begin);
    if (first == warning.npos) return warning;
    EXPECT_EQ(warning.substr(warning.size() - end.size()), end);
    return warning.substr(first + begin.size(), warning.size() - end.size() - first - begin.size());
}

TEST(ConversionWarning, NamesEverythingThatIsLeftOut) {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
        "vertex 0 1 0\nendloop\nendfacet\n";
    EXPECT_EQ(left_out(kPly, "ply", "stl"),
              "red, green, blue, quality, flags of vertices; texcoord of faces; edge; textures");
    EXPECT_EQ(
        left_out("mtllib a.mtl\no b\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl c\n"
                 "vp 1\ng d\ns 1\nf 1/1/1 2/1/1 3/1/1\nl 1 2\n# ff\n",
                 "obj", "ply"),
        "colours of vertices; groups; lines; materials; normals; objects; smoothing; "
        "texture coordinates; vp");
    EXPECT_EQ(left_out("STCNOFF\n3 1 0\n0 0 0 0 0 1 7 0 0\n1 0 0 0 0 1 7 0 0\n0 1 0 0 0 1 7 0 0\n"
                       "3 0 1 2 255 0 0\n",
                       "off", "ply"),
              "normals; texture coordinates; colours of faces; colours of vertices");
    EXPECT_EQ(left_out("solid a\n" + facet + "endsolid a\nsolid b\n" + facet, "stl", "ply"),
              "solids");
    EXPECT_EQ(
        left_out(std::string(80, ' ') + packed(1u) + std::string(48, '\0') + "ab", "stl", "ply"),
        "colours of triangles");
}

TEST(ConversionWarning, NamesFacesWithoutTriangles) {
    const std::string off = "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n3 0 1 2\n2 0 1\n";
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(converted(off, "off", "ply"), converted(obj, "obj", "ply"));
    EXPECT_EQ(left_out(off, "off", "stl"), "faces of fewer than 3 corners");
}

TEST(ConversionWarning, IsEmptyIfNothingIsLeftOut) {
    const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const char* to : {"ply", "stl"}) EXPECT_THAT(left_out(off, "off", to), IsEmpty());
    EXPECT_THAT(left_out(kPly, "ply", "PLY"), IsEmpty());
}

}  // namespace
}  // namespace tracked_mcf
