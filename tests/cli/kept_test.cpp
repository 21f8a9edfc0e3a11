// SPDX-License-Identifier: GPL-3.0-or-later
/// The program keeps everything of a file but positions and normals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "filter_tracked_mcf/hosts/cli/documents/ply_table.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

/// Returns the words of all fields of a PLY file but positions, and the number of these fields.
std::pair<std::string, std::size_t> all_but_positions(const std::filesystem::path& path) {
    std::pair<std::string, std::size_t> result;
    PlyTable(read_file(path))
        .for_each_field([&](const PlyElement& element, std::size_t row, const PlyProperty& property,
                            const Words& words) {
            if (property.name == "x" || property.name == "y" || property.name == "z") return;
            result.first += element.name + std::to_string(row) + property.name;
            for (const std::string_view word : words) result.first.append(word) += ' ';
            ++result.second;
        });
    return result;
}

TEST(EverythingElse, OfAPlyIsKept) {
    const TemporaryFolder folder;
    write_file(folder / "in.ply",
               "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 5\n"
               "property float x\nproperty float y\nproperty float z\nproperty int flags\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "property uchar alpha\nproperty float quality\nproperty float texture_u\n"
               "property float texture_v\nelement face 3\n"
               "property list uchar int vertex_indices\nproperty int flags\n"
               "property list uchar float texcoord\nproperty uchar red\nproperty double quality\n"
               "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
               "0 0 0 32 1 2 3 4 0.5 0.1 0.2\n1 0 0 0 5 6 7 8 -1.5 0.3 0.4\n"
               "0 1 0 0 9 10 11 12 nan 0.5 0.6\n0 0 1 32 13 14 15 16 1e30 0.7 0.8\n"
               "7 7 7 0 17 18 19 20 0 0.9 1\n"
               "3 0 2 1 32 6 0 0 1 0 0 1 200 0.25\n3 0 1 3 0 6 1 1 0 1 1 0 201 0.125\n"
               "4 0 3 2 1 0 8 0 0 1 0 1 1 0 1 202 1e300\n2 3\n");
    for (const char* options : {"", "--selected flags", "--boundary free --flow conformalized"}) {
        const ProgramRun run = run_program(
            folder, "in.ply out.ply --depth 3 --step-size 1e-2 " + std::string(options));
        ASSERT_EQ(run.exit_code, 0) << run.errors;
        const auto [before, fields] = all_but_positions(folder / "in.ply");
        EXPECT_EQ(fields, 5u * 8 + 3u * 5 + 2u);
        EXPECT_EQ(all_but_positions(folder / "out.ply").first, before) << options;
    }
}

/// Returns the lines of a text file that do not begin with one of `skipped`.
std::vector<std::string> lines_but(const std::filesystem::path& path,
                                   const std::vector<std::string>& skipped) {
    std::istringstream text(read_file(path));
    std::vector<std::string> result;
    for (std::string line; std::getline(text, line);) {
        const bool is_skipped = std::any_of(skipped.begin(), skipped.end(), [&](const auto& word) {
            return line.compare(0, word.size(), word) == 0;
        });
        if (!is_skipped) result.push_back(line);
    }
    return result;
}

TEST(EverythingElse, OfAnObjIsKept) {
    const TemporaryFolder folder;
    write_file(folder / "in.obj",
               "# a remark\nmtllib m.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n"
               "v 0 0 1 0.5 0.5 0.5\nvt 0 0\nvt 1 0\nvt 0.25 1\nvt 2 2\ng side\nusemtl skin\ns 1\n"
               "f 1/1 3/2 2/3\nf 1/4 2/1 4/2\ng rest\nf 1 4 3\nf 2 3 4\n");
    ASSERT_EQ(run_program(folder, "in.obj out.obj --depth 3 --step-size 1e-2").exit_code, 0);
    EXPECT_EQ(lines_but(folder / "out.obj", {"v "}), lines_but(folder / "in.obj", {"v "}));
    EXPECT_NE(read_file(folder / "out.obj"), read_file(folder / "in.obj"));
    const auto colours = [&](const char* name) {
        std::vector<std::string> result;
        for (const std::string& line :
             lines_but(folder / name, {"#", "m", "o", "vt", "g", "u", "s", "f"})) {
            std::istringstream words(line);
            std::string word, colour;
            for (int i = 0; words >> word; ++i) colour += i < 4 ? "" : word + ' ';
            result.push_back(colour);
        }
        return result;
    };
    EXPECT_EQ(colours("out.obj").size(), 4u);
    EXPECT_EQ(colours("out.obj"), colours("in.obj"));
}

TEST(EverythingElse, OfAnOffIsKept) {
    const TemporaryFolder folder;
    const std::string faces = "3 0 2 1 0.5 0.25 1\n3 0 1 3\n3 0 3 2 1 0 0\n3 1 2 3\n";
    write_file(folder / "in.off",
               "COFF\n4 4 0\n0 0 0 10 20 30 255\n1 0 0 40 50 60 255\n0 1 0 70 80 90 255\n"
               "0 0 1 1 2 3 255\n" +
                   faces);
    ASSERT_EQ(run_program(folder, "in.off out.off --depth 3 --step-size 1e-2").exit_code, 0);
    const std::string written = read_file(folder / "out.off");
    EXPECT_EQ(written.substr(written.size() - faces.size()), faces);
    for (const char* colour :
         {" 10 20 30 255\n", " 40 50 60 255\n", " 70 80 90 255\n", " 1 2 3 255\n"}) {
        EXPECT_THAT(written, ::testing::HasSubstr(colour));
    }
}

}  // namespace
}  // namespace tracked_mcf
