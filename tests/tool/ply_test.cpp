// SPDX-License-Identifier: GPL-3.0-or-later
/// PLY to PLY: only positions and normals change.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/tool/mesh_file.h"
#include "tests/tool/temporary_folder.h"

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

const std::string kPlain =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

const std::string kPlainInDoubles =
    "ply\nformat binary_little_endian 1.0\n"
    "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

const std::string kPlainBody =
    packed(0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.5) + packed(std::uint8_t{3}, 0, 1, 2);

std::string reversed(std::string bytes) {
    return {bytes.rbegin(), bytes.rend()};
}

TEST(Ply, EveryEncodingIsRead) {
    const std::string ascii =
        "ply\nformat ascii 1.0\n" + kPlain + "0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n";
    EXPECT_EQ(written_in_doubles(ascii), kPlainInDoubles + kPlainBody);

    const std::string little = "ply\nformat binary_little_endian 1.0\n" + kPlain +
                               packed(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, .5f) +
                               packed(std::uint8_t{3}, 0, 1, 2);
    EXPECT_EQ(written_in_doubles(little), kPlainInDoubles + kPlainBody);

    std::string big = "ply\nformat binary_big_endian 1.0\n" + kPlain;
    for (const float f : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, .5f}) big += reversed(packed(f));
    big += '\3';
    for (const int i : {0, 1, 2}) big += reversed(packed(i));
    EXPECT_EQ(written_in_doubles(big), kPlainInDoubles + kPlainBody);
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
    EXPECT_FALSE(file.writes_floats("out.obj"));
    TriangleMesh mesh = file.triangle_mesh();
    mesh.positions[1].x() = 1 + 1e-9;
    EXPECT_EQ(written(file, mesh, "out.ply"),
              head + vertex(0, 0, 0, 1) + vertex(1, 0, 0, 1) + vertex(0, .1f, 0, 1) + face);
}

TEST(Ply, IntegerCoordinatesBecomeDoubles) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\n"
               "property int z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const MeshFile file(folder / "in.ply");
    EXPECT_FALSE(file.writes_floats("out.ply"));
    EXPECT_NE(written(file, file.triangle_mesh(), "out.ply").find("property double x\n"),
              std::string::npos);
}

TEST(Ply, BigEndianDoublesAreRead) {
    std::string big =
        "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const double d : {0., 0., 0., 1., 0., 0., 0., 1., .5}) big += reversed(packed(d));
    big += '\3';
    for (const int i : {0, 1, 2}) big += reversed(packed(i));
    EXPECT_EQ(written_in_doubles(big), kPlainInDoubles + kPlainBody);
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

TEST(Ply, PolygonsStayWhole) {
    const std::string faces = packed(std::uint8_t{4}, 0, 1, 2, 3) +
                              packed(std::uint8_t{3}, 0, 2, 1) +
                              packed(std::uint8_t{5}, 0, 1, 2, 3, 4);
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex 5\n";
    const std::string rest = "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string content =
        head + "property double x\nproperty double y\nproperty double z\n" + rest +
        packed(0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., -1., .5, 0.) + faces;
    const std::string expected =
        head + "property double x\nproperty double y\nproperty double z\n" + rest +
        packed(0., 0., 0., 2., 0., 0., 2., 1., 0., 0., 1., 0., -2., .5, 0.) + faces;
    EXPECT_EQ(written_in_doubles(content), expected);

    const TemporaryFolder folder;
    write_file(folder / "in.ply", content);
    const std::vector<Triangle> fans = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1},
                                        {0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    EXPECT_EQ(MeshFile(folder / "in.ply").triangle_mesh().triangles, fans);
}

TEST(Ply, DegenerateDuplicateAndUnreferencedThingsStayInTheirOrder) {
    const std::string content =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
        "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "9 9 9\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n"
        "3 1 2 3\n3 1 1 2\n3 1 2 3\n3 3 2 4\n";
    const TemporaryFolder folder;
    write_file(folder / "in.ply", content);
    const TriangleMesh mesh = MeshFile(folder / "in.ply").triangle_mesh();
    const std::vector<Eigen::Vector3d> positions = {
        {9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    const std::vector<Triangle> triangles = {{1, 2, 3}, {1, 1, 2}, {1, 2, 3}, {3, 2, 4}};
    EXPECT_EQ(mesh.positions, positions);
    EXPECT_EQ(mesh.triangles, triangles);
}

TEST(Ply, FlagsThatMeanDeletedInMemoryDeleteNothing) {
    const std::string content =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty int flags\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty int flags\nend_header\n"
        "0 0 0 1\n1 0 0 1\n0 1 0 -1\n3 0 1 2 1\n";
    const TemporaryFolder folder;
    write_file(folder / "in.ply", content);
    const TriangleMesh mesh = MeshFile(folder / "in.ply").triangle_mesh();
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Ply, NormalsAreThoseOfTheNewShape) {
    // A right angle along the y axis, whose faces are as wide as they are high before x doubles.
    const std::string content =
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "property float nx\nproperty float ny\nproperty float nz\nend_header\n"
        "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n5 5 5 0 0.6 0.8\n"
        "3 0 1 2 1 0 0\n3 0 2 3 0 1 0\n";
    // Area vectors: (0, 0, 2) and (1, 0, 0); the last vertex has no face and keeps its normal.
    const double x = 1 / std::sqrt(5.0), z = 2 / std::sqrt(5.0);
    const std::string expected =
        "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty double x\n"
        "property double y\nproperty double z\nproperty double nx\nproperty double ny\n"
        "property double nz\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property double nx\nproperty double ny\nproperty double nz\nend_header\n" +
        packed(0., 0., 0., x, 0., z) + packed(2., 0., 0., 0., 0., 1.) +
        packed(0., 1., 0., x, 0., z) + packed(0., 0., 1., 1., 0., 0.) +
        packed(10., 5., 5., 0., double{.6f}, double{.8f}) +
        packed(std::uint8_t{3}, 0, 1, 2, 0., 0., 1.) + packed(std::uint8_t{3}, 0, 2, 3, 1., 0., 0.);
    const std::string written = written_in_doubles(content);
    ASSERT_EQ(written.size(), expected.size());
    const std::size_t header = expected.find("end_header\n") + 11;
    EXPECT_EQ(written.substr(0, header), expected.substr(0, header));
    // The unit vectors to rounding, everything else exactly.
    for (std::size_t i = 0; i < 30; ++i) {
        double actual, wanted;
        std::memcpy(&actual, written.data() + header + 8 * i, 8);
        std::memcpy(&wanted, expected.data() + header + 8 * i, 8);
        EXPECT_NEAR(actual, wanted, i % 6 < 3 ? 0 : 1e-15) << "number " << i;
    }
    EXPECT_EQ(written.substr(header + 240), expected.substr(header + 240));
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
    EXPECT_EQ(with_quality(header + "property float quality\n" + coordinates("double") + rest +
                           packed(9.f, 0., 0., 0., 9.f, 1., 0., 0., 9.f, 0., 1., .5) + face),
              header + "property double quality\n" + coordinates("double") + rest +
                  packed(.25, 0., 0., 0., -1., 1., 0., 0., 1e-9, 0., 1., .5) + face);
}

}  // namespace
}  // namespace tracked_mcf
