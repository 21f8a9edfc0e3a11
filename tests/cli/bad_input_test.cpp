// SPDX-License-Identifier: GPL-3.0-or-later
/// The program refuses damaged files in one line that says what is wrong, and writes no output.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct BadFile {
    std::string name, file, content, complaint;
};

std::ostream& operator<<(std::ostream& out, const BadFile& bad) {
    return out << bad.name;
}

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string binary_stl(std::uint32_t announced) {
    return std::string(80, ' ') + bytes_of(announced) + std::string(50, '\0');
}

const std::vector<BadFile> kBadFiles = {
    {"EmptyPly", "a.ply", "", "it is empty"},
    {"EmptyObj", "a.obj", "", "it is empty"},
    {"EmptyOff", "a.off", "", "it is empty"},
    {"EmptyStl", "a.stl", "", "it is empty"},
    {"GarbagePly", "a.ply", "\xff\xfe garbage", "it does not begin with 'ply'"},
    {"GarbageObj", "a.obj", "\xff\xfe garbage", "it has no vertices"},
    {"GarbageOff", "a.off", "\xff\xfe garbage", "line 1: an OFF file begins with OFF"},
    {"GarbageStl", "a.stl", "\xff\xfe garbage", "it is a text that does not begin with 'solid'"},
    {"OtherFormat", "a.ply", "OFF\n3 1 0\n", "it is not a PLY file"},
    {"TruncatedPly", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n", "it is truncated"},
    {"TruncatedBinaryPly", "a.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\n"
     "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
     "vertex_indices\nend_header\nabcdefghijklmn",
     "it is truncated"},
    {"TruncatedOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "it is truncated"},
    {"TruncatedBinaryStl", "a.stl", binary_stl(2),
     "it announces 2 triangles, which take 184 bytes, but it has 134"},
    {"HugeBinaryStl", "a.stl", binary_stl(4000000000u), "it announces 4000000000 triangles"},
    {"ListForCoordinatePly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
     "1 0 0 0\n3 0 0 0\n",
     "its vertices lack a number x, y or z"},
    {"HugeCountPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 "
     "0\n",
     "it is truncated"},
    {"NegativeCountPly", "a.ply", "ply\nformat ascii 1.0\nelement vertex -3\n", "out of range"},
    {"HugeCountOff", "a.off", "OFF\n2000000000 1 0\n0 0 0\n", "it is truncated"},
    {"NegativeCountOff", "a.off", "OFF\n-3 1 0\n0 0 0\n", "out of range"},
    {"WordForNumberPly", "a.ply", kPlyHeader + "0 0 O\n1 0 0\n0 1 0\n3 0 1 2\n",
     "'O' stands where a number should"},
    {"WordForNumberObj", "a.obj", "v 0 0 0\nv 1 0,5 0\nv 0 1 0\nf 1 2 3\n",
     "line 2: '0,5' stands where a number should"},
    {"WordForNumberOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n",
     "'x' stands where a number should"},
    {"IndexPly", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     "face 0 refers to vertex 3 of 3"},
    {"NegativeIndexPly", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n",
     "face 0 refers to vertex -2 of 3"},
    {"HugeIndexPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar double vertex_indices\nend_header\n"
     "0 0 0\n1 0 0\n0 1 0\n3 0 1 1e300\n",
     "face 0 refers to vertex 1e+300 of 3"},
    {"BrokenIndexPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar double vertex_indices\nend_header\n"
     "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
     "face 0 refers to vertex 1.5 of 3"},
    {"IndexObj", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
     "line 4: a face refers to vertex 4 of 3"},
    {"IndexZeroObj", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
     "line 4: a face has the index 0, which nothing has"},
    {"IndexOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     "line 6: a face refers to vertex 3 of 3"},
    {"IndexOfPolygonOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 99999\n",
     "line 6: a face refers to vertex 99999 of 3"},
    {"NoFacesPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
     "property float z\nend_header\n0 0 0\n",
     "it has no faces"},
    {"NoFacesObj", "a.obj", "v 0 0 0\n", "it has no faces"},
    {"NoFacesOff", "a.off", "OFF\n1 0 0\n0 0 0\n", "it has no faces"},
    {"NotANumber", "a.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", "not a finite number"},
    {"Infinite", "a.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "not a finite number"},
    {"WordForNumberStl", "a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0,5 0\nvertex 0 1 0\n"
     "endloop\nendfacet\nendsolid a\n",
     "'0,5' stands where a number should"},
    {"TwoCornersStl", "a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n"
     "endsolid a\n",
     "line 6: a facet does not have 3 vertices"},
    {"NoHeaderEndPly", "a.ply", "ply\nformat ascii 1.0\n", "it ends within its header"},
    {"MissingWordPly", "a.ply", kPlyHeader + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
     "line 11: it has fewer numbers than the header announces"},
    {"ListLengthPly", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n2.5 0 1 2\n",
     "the length of a list vertex_indices is 2.5"},
    {"StripIndexPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
     "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
     "0 0 0\n3 0 -1 -2\n",
     "tristrips 0 refers to vertex -2 of 1"},
    {"SomeListsPly", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int a\nproperty list uchar int b\n"
     "end_header\n0 0 0\n0 0\n",
     "its faces lack vertex_indices"},
    {"FewCornersPly", "a.ply", kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
     "none of its 1 faces has 3 corners or more"},
    {"IndexBeforeTheFirstObj", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
     "line 4: a face refers to vertex -4, but only 3 precede it"},
    {"DigitsObj", "a.obj", "v 0 0 0\nv 3.1+e2 0 0\nv 0 1 0\nf 1 2 3\n",
     "line 2: '3.1+e2' stands where a number should"},
    {"UsedNumberIndObj", "a.obj", "v 0 0 0\nv -1.#IND 0 0\nv 0 1 0\nf 1 2 3\n",
     "not a finite number"},
    {"VertexTooManyOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n",
     "it announces 3 vertices and 1 faces, but may have more or fewer"},
    {"FractionTooManyOff", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n.5 0 1\n3 0 1 2\n",
     "line 6: '.5' stands where a whole number should; it announces 3 vertices and 1 faces, but "
     "may have more or fewer"},
    {"LongVertexTooManyOff", "a.off",
     "OFF\n3 1 0\n0 0 0 9 9\n1 0 0 9 9\n0 1 0 9 9\n3 0 1 2 9\n3 0 1 2\n",
     "it announces 3 vertices and 1 faces, but may have more or fewer"},
    {"VertexTooManyBeforeOneLineOff", "a.off",
     "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n5 0 1\n3 0 1 2 3 0 1 2 3 0 1 2\n",
     "line 6: the line has too few numbers; it announces 3 vertices and 3 faces, but may have more "
     "or fewer"},
    {"VertexTooFewOff", "a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n3 1 2 0\n3 0 1 2\n",
     "line 6: the line of a vertex has too many numbers; it announces 4 vertices and 2 faces, but "
     "may have more or fewer"},
    {"VertexTooFewInOneLineOff", "a.off", "OFF 4 2 0 0 0 0 1 0 0 0 1 0 3 1 2 0 3 0 1 2\n",
     "or faces have fewer than 3 corners; it announces 4 vertices and 2 faces, but may have more "
     "or fewer"},
    {"TruncatedBinaryOff", "a.off",
     "OFF BINARY\n" + std::string("\0\0\0\3\0\0\0\1\0\0\0\0\0\0", 14), "it is truncated"},
    {"TextStl", "a.stl", "<html>" + std::string(100, 'x'),
     "it is a text that does not begin with 'solid'"},
    {"WithinAFacetStl", "a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
     "it ends within a facet"},
    {"TrianglesTooManyStl", "a.stl", binary_stl(1) + std::string(50, '\0'),
     "it announces 1 triangles, which take 134 bytes, but it has 184"},
    {"NoFacetsStl", "a.stl", "solid a\nendsolid a\n", "it has no vertices"},
};

class BadInput : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadInput, IsRefusedWithAReason) {
    const BadFile& bad = GetParam();
    const TemporaryFolder folder;
    write_file(folder / bad.file, bad.content);
    const ProgramRun run = run_program(folder, bad.file + " out.ply");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.errors, StartsWith("tracked_mcf: "));
    EXPECT_THAT(run.errors, HasSubstr(bad.complaint));
    EXPECT_EQ(run.errors.find('\n'), run.errors.size() - 1) << "one line";
    EXPECT_EQ(run.output, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
}

INSTANTIATE_TEST_SUITE_P(Files, BadInput, ::testing::ValuesIn(kBadFiles),
                         [](const auto& test) { return test.param.name; });

TEST(BadInput, MissingFileIsNamed) {
    const TemporaryFolder folder;
    const ProgramRun run = run_program(folder, "missing.ply out.ply");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.errors,
              "tracked_mcf: cannot read missing.ply: No such file or directory; check the name and "
              "the permissions.\n");
}

TEST(BadInput, FolderIsNotRead) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a.ply");
    const ProgramRun run = run_program(folder, "a.ply out.ply");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.errors, "tracked_mcf: a.ply is a folder; give a mesh file.\n");
}

}  // namespace
}  // namespace tracked_mcf
