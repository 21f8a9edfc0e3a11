// SPDX-License-Identifier: GPL-3.0-or-later
/// --selected and --strength: which properties of a PLY file they take, and which triangles these
/// select.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;

/// A square pyramid: a quadrangle and four triangles, of vertices 0 to 3 and the apex 4, with
/// numbers of vertices and faces, one of each by the same name, and lists.
const std::string kPyramid =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
    "property float z\nproperty float both\nproperty uchar of_vertices\nproperty int flags\n"
    "element face 5\nproperty list uchar int vertex_indices\nproperty float of_faces\n"
    "property double both\nproperty short zero\nproperty list uchar float numbers\nend_header\n"
    "0 0 0 1 1 32\n1 0 0 1 1 32\n1 1 0 1 1 48\n0 1 0 1 1 33\n0.5 0.5 1 1 0 31\n"
    "4 3 2 1 0 -0.5 0 0 1 1\n3 0 1 4 0 1e-30 0 0\n3 1 2 4 0 0 0 2 5 6\n3 2 3 4 2 0 0 0\n"
    "3 3 0 4 0 0 0 0\n";

Selection selected(const std::string& content, const std::string& name) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", content);
    return MeshFile(folder / "a.ply").selection_by(name);
}

/// The message, with the file's name in place of its path.
template <class Error>
std::string complaint(const std::string& content, const std::string& name) {
    try {
        selected(content, name);
    } catch (const Error& error) {
        const std::string message = error.what();
        const std::size_t name_in_path = message.find("a.ply");
        const std::size_t path = message.rfind(' ', name_in_path) + 1;  // 0 if there is no space
        return message.substr(0, path) + message.substr(name_in_path);
    }
    return "none";
}

TEST(Selection, AFaceIsSelectedByItsNumberAndAPolygonWithAllItsTriangles) {
    EXPECT_EQ(selected(kPyramid, "of_faces"), (Selection{1, 1, 0, 0, 1, 0}));
}

TEST(Selection, FacesOfFewCornersHaveNumbersAndNoTriangles) {
    const std::string content =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty float v\nelement face 4\n"
        "property list uchar int vertex_indices\nproperty float f\nend_header\n"
        "0 0 0 1\n1 0 0 1\n0 1 0 0\n2 0 1 1\n3 0 1 2 0\n0 1\n3 2 1 0 1\n";
    EXPECT_EQ(selected(content, "f"), (Selection{0, 1}));
    EXPECT_THROW(selected(content, "v"), InvalidMesh) << "only the face of two corners is selected";
}

TEST(Selection, APropertyOfFacesPrecedesOneOfVertices) {
    EXPECT_EQ(selected(kPyramid, "both"), (Selection{0, 0, 1, 0, 0, 0}));
}

TEST(Selection, AFaceIsSelectedIfAllItsVerticesAre) {
    EXPECT_EQ(selected(kPyramid, "of_vertices"), (Selection{1, 1, 0, 0, 0, 0}));
}

TEST(Selection, OnlyTheSelectedBitOfFlagsCounts) {
    EXPECT_EQ(selected(kPyramid, "flags"), (Selection{1, 1, 0, 0, 0, 0}));
    const auto of_flags = [](const std::string& flags) {
        return selected(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
            "property float y\nproperty float z\nelement face 2\n"
            "property list uchar int vertex_indices\nproperty double flags\n"
            "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " +
                flags + "\n3 0 2 1 32\n",
            "flags")[0];
    };
    EXPECT_EQ(of_flags("0"), 0);
    EXPECT_EQ(of_flags("31"), 0);
    EXPECT_EQ(of_flags("64"), 0);
    EXPECT_EQ(of_flags("96"), 1);
    EXPECT_EQ(of_flags("-1"), 1) << "all bits";
    EXPECT_EQ(of_flags("32.5"), 0);
    EXPECT_EQ(of_flags("1e300"), 0);
}

TEST(Selection, AMissingPropertyIsAnErrorThatListsTheOthers) {
    const std::string there_are =
        " to select by; its faces have: of_faces, both, zero; its vertices: x, y, z, both, "
        "of_vertices, flags.";
    EXPECT_EQ(complaint<InvalidParameter>(kPyramid, "quality"),
              "a.ply has no number 'quality'" + there_are);
    EXPECT_EQ(complaint<InvalidParameter>(kPyramid, "numbers"),
              "a.ply has no number 'numbers'" + there_are)
        << "a list is no number";
    EXPECT_THAT(complaint<InvalidParameter>(
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                    "q"),
                HasSubstr("its faces have: none; its vertices: x, y, z."));
}

TEST(Selection, SelectingNothingIsAnError) {
    EXPECT_THAT(complaint<InvalidMesh>(kPyramid, "z"),
                HasSubstr("No face of a.ply is selected by 'z' of its vertices; "))
        << "the apex alone is no face";
    EXPECT_EQ(complaint<InvalidMesh>(kPyramid, "zero"),
              "No face of a.ply is selected by 'zero' of its faces; select some.");
}

TEST(Strength, RefusesOtherNumbersAndFiles) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", kPyramid);
    write_file(folder / "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    for (const auto& [arguments, exit_code, message] :
         {std::tuple{"a.ply b.ply --strength of_faces", 2,
                     "The vertices of a.ply have no number 'of_faces'; they have: x, y, z, both, "
                     "of_vertices, flags."},
          std::tuple{"a.ply b.ply --strength flags", 1,
                     "The strength of vertex 3 is 33; give numbers from 0 to 1."},
          std::tuple{"a.off b.ply --strength x", 2, "--strength needs a PLY file"}}) {
        const ProgramRun run = run_program(folder, arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments;
        EXPECT_THAT(run.errors, HasSubstr(message));
    }
}

}  // namespace
}  // namespace tracked_mcf
