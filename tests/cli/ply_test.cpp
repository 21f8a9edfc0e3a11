// SPDX-License-Identifier: GPL-3.0-or-later
/// PLY to PLY: only positions and normals change.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

/// Reads `content`, multiplies x of every vertex by 2, and returns what is written, in doubles.
std::string written_in_doubles(const std::string& content) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply", content);
    MeshFile file(folder / "in.ply");
    TriangleMesh mesh = file.triangle_mesh();
    for (auto& p : mesh.positions) p.x() *= 2;
    file.write_doubles();
    EXPECT_FALSE(file.writes_floats("out.ply"));
    return written(file, mesh, "out.ply");
}

TEST(Ply, CoordinatesAndNormalsKeepTheirType) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nproperty double nx\nproperty float ny\n"
        "property float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string face = packed(std::uint8_t{3}, 0, 1, 2);
    const auto vertex = [](float x, float y, double nx, float nz) {
        return packed(x, y, 0.f) + packed(nx) + packed(0.f, nz);
    };
    const TemporaryFolder folder;
    write_file(folder / "in.ply",
               head + vertex(0, 0, 1, 0) + vertex(1, 0, 1, 0) + vertex(0, .1f, 1, 0) + face);
    const MeshFile file(folder / "in.ply");
    EXPECT_TRUE(file.writes_floats("out.ply"));
    EXPECT_TRUE(file.writes_floats("out.stl"));
    TriangleMesh mesh = file.triangle_mesh();
    mesh.positions[1].x() = 1 + 1e-9;
    EXPECT_EQ(written(file, mesh, "out.ply"),
              head + vertex(0, 0, 0, 1) + vertex(1, 0, 0, 1) + vertex(0, .1f, 0, 1) + face);
}

TEST(Ply, EveryPropertyElementAndCommentIsKept) {
    const std::string properties_before =
        "comment a remark\nobj_info from a scanner\ncomment TextureFile skin.png\n";
    const std::string properties_after =
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
        "property float confidence\nproperty float radius\nproperty short curvature_class\n"
        "property list ushort double history\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty uint material\n"
        "property list uchar float texcoord\nproperty int texnumber\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property double quality\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty char crease\n"
        "element sensor 1\nproperty double gain\nend_header\n";
    const auto vertex = [](auto x, auto y, auto z, std::uint8_t shade) {
        return packed(x, y, z, shade, std::uint8_t{20}, std::uint8_t{30}, std::uint8_t{40}, .25f,
                      1.5f, std::int16_t{-7}, std::uint16_t{2}, 1e-300, -4.0);
    };
    const auto face = [](int a, int b, int c) {
        return packed(std::uint8_t{3}, a, b, c, 4000000000u, std::uint8_t{6}, 0.f, .1f, .2f, .3f,
                      .4f, .5f, 0, std::uint8_t{9}, std::uint8_t{8}, std::uint8_t{7}, .125);
    };
    const std::string faces_and_more =
        face(0, 1, 2) + face(2, 1, 3) + packed(0, 3, std::int8_t{-1}) + packed(3.25);
    const std::string content =
        "ply\nformat binary_little_endian 1.0\n" + properties_before +
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
        properties_after + vertex(0.f, 0.f, 0.f, 1) + vertex(1.f, 0.f, 0.f, 2) +
        vertex(0.f, 1.f, 0.f, 3) + vertex(1.f, 1.f, .5f, 4) + faces_and_more;
    const std::string expected =
        "ply\nformat binary_little_endian 1.0\n" + properties_before +
        "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n" +
        properties_after + vertex(0., 0., 0., 1) + vertex(2., 0., 0., 2) + vertex(0., 1., 0., 3) +
        vertex(2., 1., .5, 4) + faces_and_more;
    EXPECT_EQ(written_in_doubles(content), expected);
}

TEST(Ply, AListNamedLikeACoordinateIsKeptBesideIt) {
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
    const std::string rest =
        "property list uchar double x\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n";
    const std::string face = packed(std::uint8_t{3}, 0, 1, 2);
    const std::string empty_list = packed(std::uint8_t{0});
    const std::string long_list = packed(std::uint8_t{2}, 7., 8.);
    const auto lists = [&](auto zero, auto x, auto one) {
        return packed(zero, zero, zero) + empty_list + packed(x, zero, zero) + long_list +
               packed(zero, one, zero) + empty_list;
    };
    EXPECT_EQ(written_in_doubles(head + "property float x\nproperty float y\nproperty float z\n" +
                                 rest + lists(0.f, 1.f, 1.f) + face),
              head + "property double x\nproperty double y\nproperty double z\n" + rest +
                  lists(0., 2., 1.) + face);
}

TEST(Ply, NormalsAreThoseOfTheNewShape) {
    // A right angle along the y axis, whose faces are as wide as they are high before x doubles.
    // The last vertex has no face and keeps its normal.
    const auto content = [](const std::string& type, const std::string& x,
                            const std::string& tilted, const std::string& flat,
                            const std::string& upright, const std::string& unused,
                            const std::string& faces) {
        std::string header = "ply\nformat ascii 1.0\nelement vertex 5\n";
        for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
            header += "property " + type + ' ' + name + '\n';
        header += "element face 2\nproperty list uchar int vertex_indices\n";
        for (const char* name : {"nx", "ny", "nz"})
            header += "property " + type + ' ' + name + '\n';
        return header + "end_header\n0 0 0 " + tilted + '\n' + x + " 0 0 " + flat + "\n0 1 0 " +
               tilted + "\n0 0 1 " + upright + '\n' + unused + '\n' + faces;
    };
    // Area vectors: (0, 0, 2) and (1, 0, 0).
    const std::string tilted = "0.4472135954999579 0 0.8944271909999159";
    EXPECT_EQ(written_in_doubles(content("float", "1", "0 0 1", "0 0 1", "0 0 1",
                                         "5 5 5 0 0.5 0.75", "3 0 1 2 1 0 0\n3 0 2 3 0 1 0\n")),
              content("double", "2", tilted, "0 0 1", "0 0 1", "10 5 5 0 0.5 0.75",
                      "3 0 1 2 0 0 1\n3 0 2 3 0 1 0\n"));
}

TEST(Ply, TextBecomesDoublesThatMeanTheFloats) {
    const auto content = [](const std::string& type, const std::string& tenth) {
        std::string header = "ply\nformat ascii 1.0\nelement vertex 3\n";
        for (const char* name : {"x", "y", "z"}) header += "property " + type + ' ' + name + '\n';
        return header + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 " +
               tenth + "\n0 1 0\n0 0 0\n3 0 1 2\n";
    };
    EXPECT_EQ(written_in_doubles(content("float", "0.1")),
              content("double", "0.10000000149011612"));
    EXPECT_EQ(written_in_doubles(content("double", "0.10")), content("double", "0.10"));
}

TEST(Ply, TheQualityReplacesThePropertyOfThatNameOrComesLast) {
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n";
    const auto coordinates = [](const std::string& type) {
        return "property " + type + " x\nproperty " + type + " y\nproperty " + type + " z\n";
    };
    const std::string rest = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string face = packed(std::uint8_t{3}, 0, 1, 2);
    const TemporaryFolder folder;
    const auto with_quality = [&](const std::string& content) {
        write_file(folder / "in.ply", content);
        MeshFile file(folder / "in.ply");
        file.set_quality({0.25, -1, 1e-9});
        return written(file, file.triangle_mesh(), "out.ply");
    };
    EXPECT_EQ(with_quality(header + coordinates("float") + rest +
                           packed(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, .5f) + face),
              header + coordinates("float") + "property double quality\n" + rest +
                  packed(0.f, 0.f, 0.f) + packed(.25) + packed(1.f, 0.f, 0.f) + packed(-1.) +
                  packed(0.f, 1.f, .5f) + packed(1e-9) + face);
    const std::string text =
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
        "property float y\r\nproperty float z\r\n";
    EXPECT_EQ(with_quality(text + "comment a\r\n" + rest + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              text + "property double quality\r\ncomment a\r\n" + rest +
                  "0 0 0 0.25\n1 0 0 -1\n0 1 0 1e-09\n3 0 1 2\n");
    const std::string list = "property list uchar int quality\r\n";
    EXPECT_EQ(with_quality(text + list + rest + "0 0 0 2 7 8\n1 0 0 0\n0 1 0 1 7\n3 0 1 2\n"),
              text + "property double quality\r\n" + rest +
                  "0 0 0 0.25\n1 0 0 -1\n0 1 0 1e-09\n3 0 1 2\n");
    EXPECT_EQ(with_quality(header + "property float quality\n" + coordinates("double") + rest +
                           packed(9.f, 0., 0., 0., 9.f, 1., 0., 0., 9.f, 0., 1., .5) + face),
              header + "property double quality\n" + coordinates("double") + rest +
                  packed(.25, 0., 0., 0., -1., 1., 0., 0., 1e-9, 0., 1., .5) + face);
}

}  // namespace
}  // namespace tracked_mcf
