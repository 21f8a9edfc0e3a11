// SPDX-License-Identifier: GPL-3.0-or-later
/// Corners of the file formats: small files, their triangles, and what is written if every x is
/// doubled. Everything else stays to the letter.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

/// A file. Its format follows the last '_' of the name.
struct Case {
    std::string name, before, after, triangles = "0 1 2; ";
};

std::ostream& operator<<(std::ostream& out, const Case& file) {
    return out << file.name;
}

/// Returns a text file in which <before|after> marks what changes.
Case text(const std::string& name, const std::string& marked,
          const std::string& triangles = "0 1 2; ") {
    Case result{name, "", "", triangles};
    bool in_before = true, in_after = true;
    for (const char c : marked) {
        if (c == '<') {
            in_after = false;
        } else if (c == '|') {
            std::swap(in_before, in_after);
        } else if (c == '>') {
            in_before = true;
        } else {
            if (in_before) result.before += c;
            if (in_after) result.after += c;
        }
    }
    return result;
}

std::string with_returns(std::string text) {
    for (char& c : text) c = c == '\n' ? '\r' : c;
    return text;
}

std::string upper_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(c));
    return text;
}

class Reading : public ::testing::TestWithParam<Case> {};

TEST_P(Reading, GivesTheTrianglesAndKeepsTheRest) {
    const Case& file = GetParam();
    const std::string extension = file.name.substr(file.name.rfind('_') + 1);
    const TemporaryFolder folder;
    write_file(folder / ("in." + extension), file.before);
    std::string triangles;
    for (const Triangle& t : MeshFile(folder / ("in." + extension)).triangle_mesh().triangles) {
        for (const std::int32_t vertex : t) triangles += std::to_string(vertex) + ' ';
        triangles.back() = ';';
        triangles += ' ';
    }
    EXPECT_EQ(triangles, file.triangles);
    EXPECT_EQ(written_with_x_doubled(file.before, extension), file.after);
}

const std::string kBom = "\xEF\xBB\xBF";

const std::string kV = "v 0 0 0\nv <1|2> 0 0\nv 0 1 0\n";

const std::vector<Case> kObjFiles = {
    text("Returns_obj", with_returns(kV + "f 1 2 3\n")),
    text("ReturnsAndFeeds_obj", "v 0 0 0\r\nv <1|2> 0 0\r\nv 0 1 0\r\nf 1 2 3"),
    text("ByteOrderMark_obj", kBom + kV + "v <7|14> 7 7\nf 1 2 3\n"),
    text("ContinuedLines_obj", "v 0 0 0\nv \\\n <1|2> 0\\\r\n 0\nv 0 1 0\nf 1 2 \\\n\\\n3\n"),
    text("NoContinuationInComments_obj", kV + "# C:\\\nf 1 2 3 # C:\\\nf 3 2 1\n",
         "0 1 2; 2 1 0; "),
    text("Comments_obj",
         "v 0 0 0 # a\nv <1|2> 0 0# b\nv 0 1 0 #c 1 1 1\nvn 0 0 <5|1> # n\n"
         "f 1//1 2//1 3//1 # f\n"),
    text("FacesFirst_obj", "f 1//1 2//1 3//1\n" + kV + "vn 0 0 <5|1>\n"),
    text("FromTheEnd_obj", kV + "f -3 -2 -1\nv <8|16> 8 8\nf -4 -3 -2\n", "0 1 2; 0 1 2; "),
    text("NoSuchNormal_obj", kV + "vn 0 0 <5|1>\nf 1//1 2//-2 3//9\nf 1//9 2//9 3//9\n",
         "0 1 2; 0 1 2; "),
    text("NoSuchTexture_obj", kV + "f 1/1 2/-7 3/99999999999\n"),
    text("FourthWordOfANormal_obj", kV + "vn 0 0 <5|1> 1\nf 1//1 2//1 3//1\n"),
    text("NormalsThatAreNoNumbers_obj", kV + "vn -1.#IND00 1.#QNAN nan\nvn <-1.#IND|0> <1.#INF|0> "
                                             "<-nan(ind)|1>\nf 1//2 2//2 3//2\n"),
    text("NormalsOfCollinearFaces_obj",
         "v <0.04|0.08> 0.05 0.06\nv <0.01|0.02> 0.02 0.03\nv <0.07|0.14> 0.08 0.09\n"
         "vn 0.8 0.6 0\nf 1//1 2//1 3//1\n"),
    text("TwoCoordinates_obj", "v 0 0\nv <1|2> 0\nv 0 1\nf 1 2 3\n"),
    text("FewCorners_obj", kV + "f 1\nf 1 2\nf\nf 1 2 3\n"),
    text("FewNormals_obj", kV + "vn 0 0 <5|1>\nf 1//1 2//1 3\nf 3 2 1\n", "0 1 2; 2 1 0; "),
    text("BlanksFirst_obj", " v 0 0 0\n\tv <1|2> 0 0\nv 0 1 0\n f 1 2 3\n"),
    text("AVertexTwice_obj", kV + "f 1 2 2\nf 1 2 3\n", "0 1 1; 0 1 2; "),
    text("AnyLines_obj", kV + "f 1 2 3\nl 1 0\nl 1 2/3 -9 99 x\n"),
    text("ZerosAtTheEnd_obj", kV + "f 1 2 3\n\x1A" + std::string(3, '\0')),
};
INSTANTIATE_TEST_SUITE_P(Obj, Reading, ::testing::ValuesIn(kObjFiles),
                         [](const auto& test) { return test.param.name; });

const std::string kP = "0 0 0\n<1|2> 0 0\n0 1 0\n";

std::string big_endian(const std::vector<double>& floats) {
    std::string bytes;
    for (const double number : floats) {
        const std::string little = packed(static_cast<float>(number));
        bytes.append(little.rbegin(), little.rend());
    }
    return bytes;
}

/// Big-endian whole numbers from 0 to 255.
std::string big_endian(std::initializer_list<int> numbers) {
    std::string bytes;
    for (const int number : numbers) bytes += std::string(3, '\0') + static_cast<char>(number);
    return bytes;
}

std::string binary_off(double x, double z) {
    return "NOFF BINARY\n" + big_endian({3, 1, 0}) +
           big_endian(std::vector<double>{0, 0, 0, 0, 0, z, x, 0, 0, 0, 0, z, 0, 1, 0, 0, 0, z}) +
           big_endian({3, 0, 1, 2, 1}) + big_endian(std::vector<double>{0.5});
}

const std::vector<Case> kOffFiles = {
    text("ByteOrderMarkAndReturns_off", with_returns(kBom + "OFF\n3 1 0\n" + kP + "3 0 1 2\n")),
    text("Comments_off",
         "#a\nOFF # b\n3 1 0#c\n0 0 0 # d\n<1|2> 0 0# e\n#f\n0 1 0\n3 0 1 2 #g\n#h"),
    text("NoEdges_off", "OFF\n3 1\n" + kP + "3 0 1 2\n"),
    text("CountsInLines_off", "OFF\n3\n1\n0\n" + kP + "3 0 1 2\n"),
    text("CountsBesideTheKeyword_off", "OFF 3 1 0\n" + kP + "3 0 1 2\n"),
    text("NoKeyword_off", "3 1 0\n" + kP + "3 0 1 2\n"),
    text("SmallLetters_off", "off\n3 1 0\n" + kP + "3 0 1 2\n"),
    text("WordsAfterVertices_off",
         "OFF\n3 1 0\n0 0 0 255 0 0\n<1|2> 0 0 1 1\n0 1 0 x\n3 0 1 2 -1\n"),
    text("ColoursOfFaces_off", "OFF\n3 3 0\n" + kP + "3 0 1 2 5000\n3 0 1 2 -1\n3 0 1 2 red\n",
         "0 1 2; 0 1 2; 0 1 2; "),
    text("AnyLines_off", "OFF\n3 2 0\n0 0\n0 <1|2> 0 0\n0\n1 0 3 0\n 1 2 3 2 1 0",
         "0 1 2; 2 1 0; "),
    text("OneLine_off", "OFF 3 1 0 0 0 0 <1|2> 0 0 0 1 0 3 0 1 2"),
    text("FacesInOneLine_off", "OFF\n3 2 0\n" + kP + "3 0 1 2 3 2 1 0\n", "0 1 2; 2 1 0; "),
    text("ColoursInOneLine_off",
         "COFF 3 1 0 0 0 0 1 0 0 1 <1|2> 0 0 1 0 0 1 0 1 0 1 0 0 1 3 0 1 2"),
    text("FewCorners_off", "OFF\n3 4 0\n" + kP + "2 0 1\n1 0\n0\n3 0 1 2\n"),
    text("LinesAfterTheFaces_off", "OFF\n3 1 0\n" + kP + "3 0 1 2\nmore\n"),
    {"Binary_off", binary_off(1, -5), binary_off(2, 1)},
};
INSTANTIATE_TEST_SUITE_P(Off, Reading, ::testing::ValuesIn(kOffFiles),
                         [](const auto& test) { return test.param.name; });

const std::string kVertex3 =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace1 = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kHead = "ply\nformat ascii 1.0\n";
const std::string kEnd = "end_header\n";

std::string of_face(const std::string& property) {
    return kHead + kVertex3 + "element face 1\n" + property + '\n' + kEnd + kP + "3 0 1 2\n";
}

std::string binary_ply(const std::string& line_end, char order, double x) {
    std::string header = "ply\nformat binary_" + std::string(order == 'b' ? "big" : "little") +
                         "_endian 1.0\n" + kVertex3 + "property double u\n" + kFace1 +
                         "property list int64 uint64 more\n" + kEnd;
    std::string result;
    for (const char c : header) result += c == '\n' ? line_end : std::string(1, c);
    const auto number = [&](auto value) {
        const std::string bytes = packed(value);
        return order == 'b' ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
    };
    // The first byte of the first number is a line feed in the little-endian order.
    const float first = 8388608 + 10;
    for (const float f : {first, static_cast<float>(x), 0.f}) {
        result += number(f == first ? f * static_cast<float>(x) : f) + number(0.f) +
                  number(f == 0 ? 1.f : 0.f) + number(1e-300);
    }
    return result + '\3' + number(0) + number(1) + number(2) + number(std::int64_t{1}) +
           number(std::uint64_t{7}) + "bytes after the last face";
}

const std::vector<Case> kPlyFiles = {
    text("HeaderLines_ply", "ply\nformat ascii 1.0\n\nauthor me\n" + kVertex3 + "comment a\n" +
                                kFace1 + "obj_info b\n\n" + kEnd + kP + "3 0 1 2\n"),
    text("CommentsBetweenElements_ply",
         kHead + "comment a\n" +
             "element vertex 3\ncomment  b \nproperty float x\nproperty float y\n"
             "obj_info c\nproperty float z\ncomment d\n" +
             kFace1 + "comment e\n" + kEnd + kP + "3 0 1 2\n"),
    text("Returns_ply", with_returns(kBom + kHead + kVertex3 + kFace1 + kEnd + kP + "3 0 1 2")),
    text("UpperCase_ply", upper_case(kHead + kVertex3 + kFace1 + kEnd) + kP + "3 0 1 2\n"),
    text("NumbersBesideTheirType_ply",
         kHead + kVertex3 + "property uchar red\nproperty uchar s\nproperty int n\n" + kFace1 +
             kEnd +
             "0 0 0 255.0 256 -1\n<1.0|2> 0 0.0 -1 1e3 nan\n0 1 0 0.5 +7 1.5\n3.0 0 1.0 2\n"),
    text("WordsThatDoNotChange_ply",
         kHead + kVertex3 + kFace1 + kEnd + "0 0 0\n<1.00000001|2> -0 00\n0 1e0 0\n3 0 1 2\n"),
    text("RowsInAnyLines_ply", kHead + kVertex3 + kFace1 + kEnd + "0 0\n0 <1|2> 0 0 0 1 0 3 0 1 2"),
    text("MoreWordsInRows_ply",
         kHead + kVertex3 + kFace1 + kEnd + "0 0 0 9 9\n<1|2> 0 0 9\n0 1 0 9\n3 0 1 2 9\n"),
    text("ListLengthsThatAreFloats_ply", of_face("property list float double vertex_indices")),
    text("LongIntegers_ply", of_face("property list uint64 int64 vertex_index")),
    text("OtherNameOfIndices_ply", of_face("property list uchar int vertex_indexes")),
    text("OnlyListOfWholeNumbers_ply", of_face("property list uchar int corners")),
    text("FewCorners_ply", kHead + kVertex3 +
                               "element face 4\nproperty list uchar int vertex_indices\n" + kEnd +
                               kP + "1 0\n0\n3 0 1 2\n2 0 1\n"),
    text("Strips_ply",
         kHead +
             "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "element tristrips 1\nproperty list int int vertex_indices\n" +
             kEnd + kP + "0 0 1\n14 0 1 2 3 3 -1 3 2 1 -1 0 1 -1 2\n",
         "0 1 2; 2 1 3; 3 2 1; "),
    text("FacesAndStrips_ply",
         kHead + "element tristrips 1\nproperty list int int vertex_indices\n" + kVertex3 + kFace1 +
             kEnd + "3 2 1 0\n" + kP + "3 0 1 2\n",
         "0 1 2; 2 1 0; "),
    text("DegenerateDuplicateAndUnreferenced_ply",
         kHead +
             "element vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
             "element face 4\nproperty list uchar int vertex_indices\n" +
             kEnd + "<9|18> 9 9\n0 0 0\n<1|2> 0 0\n0 1 0\n0 0 0\n" +
             "3 1 2 3\n3 1 1 2\n3 1 2 3\n3 3 2 4\n",
         "1 2 3; 1 1 2; 1 2 3; 3 2 4; "),
    text("FlagsThatMeanDeleted_ply", kHead + kVertex3 + "property int flags\n" + kFace1 +
                                         "property int flags\n" + kEnd +
                                         "0 0 0 1\n<1|2> 0 0 1\n0 1 0 -1\n3 0 1 2 1\n"),
    text("NormalsOfFloatsThatAreCollinear_ply",
         kHead + kVertex3 + "property float nx\nproperty float ny\nproperty float nz\n" + kFace1 +
             "property float nx\nproperty float ny\nproperty float nz\n" + kEnd +
             "<0.1|0.2> 0.1 0 0 0.6 0.8\n<0.3|0.6> 0.3 0 0 0.6 0.8\n<0.7|1.4> 0.7 0 0 0.6 0.8\n"
             "3 0 1 2 0 1 0\n"),
    text("IntegerCoordinatesBecomeDoubles_ply",
         kHead +
             "element vertex 3\nproperty <int|double> x\nproperty <short|double> y\n"
             "property <uchar|double> z\n" +
             kFace1 + kEnd + kP + "3 0 1 2\n"),
    text("PolygonsStayWhole_ply",
         kHead +
             "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 2\nproperty list uchar int vertex_indices\n" +
             kEnd + kP + "<-1|-2> 1 0\n<-1|-2> 0 0\n4 0 1 2 3\n5 0 1 2 3 4\n",
         "0 1 2; 0 2 3; 0 1 2; 0 2 3; 0 3 4; "),
    {"LittleEndian_ply", binary_ply("\n", 'l', 1), binary_ply("\n", 'l', 2)},
    {"LittleEndianAfterReturns_ply", binary_ply("\r", 'l', 1), binary_ply("\r", 'l', 2)},
    {"BigEndianAfterBoth_ply", binary_ply("\r\n", 'b', 1), binary_ply("\r\n", 'b', 2)},
};
INSTANTIATE_TEST_SUITE_P(Ply, Reading, ::testing::ValuesIn(kPlyFiles),
                         [](const auto& test) { return test.param.name; });

std::string facet(const std::string& normal = "0 0 1") {
    return "facet normal " + normal +
           "\n outer loop\n  vertex 0 0 0\n  vertex <1|2> 0 0\n"
           "  vertex 0 1 0\n endloop\nendfacet\n";
}

std::string in_one_line(std::string text) {
    for (char& c : text) c = c == '\n' ? ' ' : c;
    return text;
}

std::string binary_stl(float x, float normal, const std::string& begin) {
    return begin + std::string(80 - begin.size(), ' ') +
           packed(1u, 0.f, 0.f, normal, 0.f, 0.f, 0.f, x, 0.f, 0.f, 0.f, 1.f, 0.f,
                  std::uint16_t{7});
}

const std::string kTwo = "0 1 2; 3 4 5; ";

const std::vector<Case> kStlFiles = {
    text("Solids_stl",
         "solid a\n" + facet("0 0 <9|1>") + "endsolid a\nsolid second vertex of two\n" + facet() +
             "endsolid second vertex of two",
         kTwo),
    text("BlanksFirst_stl", " \n\r\n\tsolid a\n" + facet() + "endsolid a\n"),
    text("ByteOrderMarkAndReturns_stl",
         with_returns(kBom + "solid a\n" + facet() + "endsolid a\n")),
    text("AnyCase_stl", "SOLID A\n" + upper_case(facet()) + "Endsolid A\n"),
    text("NoEnd_stl", "solid a\n" + facet()),
    text("NoSolid_stl", facet()),
    text("ZerosAtTheEnd_stl", "solid a\n" + facet() + "endsolid\n" + std::string(2, '\0') + "\x1A"),
    text("OneLine_stl", in_one_line("solid a vertex " + facet() + "endsolid a solid b " + facet()),
         kTwo),
    text("NormalsThatAreNoNumbers_stl", "solid\n" + facet("<-1.#IND|0> <nan|0> <1|1>")),
    text("Floats_stl",
         "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex "
         "<1.1|2.2> 0 0\nvertex 0 1.10000000000000000001 0\nendloop\nendfacet\n"),
    {"Binary_stl", binary_stl(1, 9, "a"), binary_stl(2, 1, "a")},
    {"BinaryThatBeginsWithSolid_stl", binary_stl(1, 9, "solid"), binary_stl(2, 1, "solid")},
    {"BytesAfterTheLastTriangle_stl", binary_stl(1, 1, "") + "more", binary_stl(2, 1, "") + "more"},
};
INSTANTIATE_TEST_SUITE_P(Stl, Reading, ::testing::ValuesIn(kStlFiles),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace tracked_mcf
