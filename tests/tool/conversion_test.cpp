/// From one format to another: what both can carry arrives.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "filter_tracked_mcf/tool/mesh_file.h"
#include "tests/tool/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// A line of words, of which those with a point end neither with zeros nor with it.
std::string without_zeros_at_ends(const std::string& line) {
    std::istringstream words(line);
    std::string result;
    for (std::string word; words >> word;) {
        if (word.find('.') != word.npos) word.erase(word.find_last_not_of('0') + 1);
        if (word.back() == '.') word.pop_back();
        result += (result.empty() ? "" : " ") + word;
    }
    return result;
}

/// Without zeros that change no number: how many digits vcglib writes depends on its release.
std::vector<std::string> lines_of_obj(const std::filesystem::path& path) {
    std::vector<std::string> lines = lines_of(path);
    for (std::string& line : lines) line = without_zeros_at_ends(line);
    return lines;
}

/// Digits that floats do not have, colours, and texture coordinates with a seam.
const std::string kTexturedPly =
    "ply\nformat ascii 1.0\ncomment TextureFile skin.png\n"
    "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 2\nproperty list uchar int vertex_indices\n"
    "property list uchar float texcoord\nend_header\n"
    "0 0 1e-9 255 0 0\n1.23456789012345 0 0 0 255 0\n0 1 0 0 0 255\n1 1 0 255 255 255\n"
    "3 0 1 2 6 0 0 1 0 0 1\n3 2 1 3 6 0.5 0.5 0.75 0.5 0.75 0.75\n";

class Conversion : public ::testing::TestWithParam<const char*> {};

TEST_P(Conversion, KeepsPositionsToTheLastDigitAndFacesInOrder) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply", kTexturedPly);
    MeshFile file(folder / "in.ply");
    const TriangleMesh mesh = file.triangle_mesh();
    const auto out = folder / (std::string("out.") + GetParam());
    file.write(mesh, out, folder.path());
    const TriangleMesh read = MeshFile(out).triangle_mesh();
    EXPECT_EQ(read.positions, mesh.positions);
    EXPECT_EQ(read.triangles, mesh.triangles);
}

INSTANTIATE_TEST_SUITE_P(To, Conversion, ::testing::Values("ply", "obj", "off"));

TEST(ConversionToObj, KeepsColoursTextureCoordinatesAndTexture) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply", kTexturedPly);
    MeshFile file(folder / "in.ply");
    file.write(file.triangle_mesh(), folder / "out.obj", folder.path());
    const auto lines = lines_of_obj(folder / "out.obj");
    EXPECT_THAT(lines, IsSupersetOf({"mtllib ./out.obj.mtl", "f 1/1 2/2 3/3", "f 3/4 2/5 4/6",
                                     "vt 0.5 0.5", "vt 0.75 0.75"}));
    EXPECT_THAT(lines, Contains(HasSubstr(" 0 0 0 1 0")));  // green
    EXPECT_THAT(lines_of(folder / "out.obj.mtl"), Contains("map_Kd skin.png"));
}

TEST(ConversionToObj, TriangulatesPolygonsWithTheirTextureCoordinates) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
               "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "property list uchar float texcoord\nend_header\n"
               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n");
    MeshFile file(folder / "in.ply");
    file.write(file.triangle_mesh(), folder / "out.obj", folder.path());
    EXPECT_THAT(lines_of_obj(folder / "out.obj"),
                IsSupersetOf({"vt 1 0", "vt 0 1", "f 1/1 2/2 3/3", "f 1/1 3/3 4/4"}));
}

TEST(ConversionToOff, KeepsColours) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply", kTexturedPly);
    MeshFile file(folder / "in.ply");
    file.write(file.triangle_mesh(), folder / "out.off", folder.path());
    EXPECT_THAT(lines_of(folder / "out.off"),
                IsSupersetOf({"COFF", "4 2 0", "0 1 0 0 0 255 255 ", "3 2 1 3 "}));
}

TEST(ConversionToPly, KeepsTextureNormalsAndColoursOfAnObj) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "out");
    write_file(folder / "in.mtl", "newmtl skin\nKd 1 0 0\nmap_Kd skin.png\n");
    write_file(folder / "in.obj",
               "mtllib in.mtl\nv 0 0 0 0 1 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n"
               "vt 0 0\nvt 1 0\nvt 0.5 1\nvt 2 2\nvn 1 0 0\nusemtl skin\nf 1/1/1 2/2/1 3/4/1\n");
    MeshFile file(folder / "in.obj");
    file.write(file.triangle_mesh(), folder / "out/out.ply", folder / "out");
    const auto color = [](std::uint8_t r, std::uint8_t g, std::uint8_t b) {
        return packed(r, g, b, std::uint8_t{255});
    };
    EXPECT_EQ(
        read_file(folder / "out/out.ply"),
        "ply\nformat binary_little_endian 1.0\ncomment VCGLIB generated\n"
        "comment TextureFile ../skin.png\n"
        "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "property double nx\nproperty double ny\nproperty double nz\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
        "element face 1\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
        "end_header\n" +
            packed(0., 0., 0., 0., 0., 1.) + color(0, 255, 0) + packed(1., 0., 0., 0., 0., 1.) +
            color(0, 255, 0) + packed(0., 1., 0., 0., 0., 1.) + color(0, 0, 255) +
            packed(std::uint8_t{3}, 0, 1, 2) +
            packed(std::uint8_t{6}, 0.f, 0.f, 1.f, 0.f, 2.f, 2.f) + color(255, 0, 0));
}

TEST(ConversionToStl, WritesFloatsAndNormals) {
    const TemporaryFolder folder;
    write_file(folder / "in.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n");
    MeshFile file(folder / "in.off");
    file.write(file.triangle_mesh(), folder / "out.stl", folder.path());
    EXPECT_EQ(
        read_file(folder / "out.stl").substr(80),
        packed(1u, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 1.f, 0.f, std::uint16_t{0}));
}

}  // namespace
}  // namespace tracked_mcf
