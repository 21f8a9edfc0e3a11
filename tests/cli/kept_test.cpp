// SPDX-License-Identifier: GPL-3.0-or-later
/// The program keeps the bits of constrained vertices, and everything of a file but positions and
/// normals.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <ostream>
#include <sstream>

#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/documents/ply_table.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using Marks = std::vector<bool>;
using Location = std::array<double, 3>;

/// Numbers the vertices; coincident vertices get the same number.
std::vector<std::size_t> location_numbers(const Points& positions) {
    std::map<Location, std::size_t> numbers;
    std::vector<std::size_t> result;
    for (const Eigen::Vector3d& p : positions) {
        result.push_back(numbers.try_emplace({p.x(), p.y(), p.z()}, numbers.size()).first->second);
    }
    return result;
}

template <class Visit>
void for_each_side(const Polygons& polygons, Visit visit) {
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const std::size_t count = polygons.corner_count(i);
        for (std::size_t k = 0; k < count; ++k) {
            visit(i, static_cast<std::size_t>(polygons.corners[polygons.first[i] + k]),
                  static_cast<std::size_t>(polygons.corners[polygons.first[i] + (k + 1) % count]));
        }
    }
}

/// Returns for each vertex whether a boundary edge ends there.
Marks boundary_vertices(const FileDocument& document) {
    const std::vector<std::size_t> number_of = location_numbers(document.positions());
    std::map<std::pair<std::size_t, std::size_t>, int> sides;
    for_each_side(document.polygons(), [&](std::size_t, std::size_t a, std::size_t b) {
        if (number_of[a] != number_of[b]) ++sides[std::minmax({number_of[a], number_of[b]})];
    });
    Marks at(number_of.size(), false);
    for (const auto& [edge, count] : sides) {
        if (count == 1) at[edge.first] = at[edge.second] = true;
    }
    Marks result;
    for (const std::size_t number : number_of) result.push_back(at[number]);
    return result;
}

/// Returns the marks, and marks all vertices that coincide with a marked one.
Marks with_twins(const Marks& marks, const Points& positions) {
    const std::vector<std::size_t> number_of = location_numbers(positions);
    Marks at(number_of.size(), false), result;
    for (std::size_t i = 0; i < number_of.size(); ++i) {
        if (marks[i]) at[number_of[i]] = true;
    }
    for (const std::size_t number : number_of) result.push_back(at[number]);
    return result;
}

/// Returns for each vertex whether a face uses it.
Marks used_vertices(const FileDocument& document) {
    Marks result(document.positions().size(), false);
    for (const std::int32_t corner : document.polygons().corners) {
        result[static_cast<std::size_t>(corner)] = true;
    }
    return result;
}

/// Returns for each vertex whether it has the same bits in both.
Marks unchanged(const Points& a, const Points& b) {
    Marks result;
    for (std::size_t i = 0; i < a.size(); ++i) {
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the representation is the point
        result.push_back(std::memcmp(a[i].data(), b[i].data(), 3 * sizeof(double)) == 0);
    }
    return result;
}

/// Expects that marked and unused vertices are unchanged and that nearly all others have moved.
void expect_kept(const FileDocument& before, const FileDocument& after, const Marks& kept) {
    ASSERT_EQ(before.positions().size(), after.positions().size());
    const Marks same = unchanged(before.positions(), after.positions());
    const Marks used = used_vertices(before);
    std::size_t held = 0, others = 0, moved = 0;
    for (std::size_t i = 0; i < same.size(); ++i) {
        if (kept[i] || !used[i]) {
            EXPECT_TRUE(same[i]) << "vertex " << i;
        } else {
            ++others;
            moved += same[i] ? 0 : 1;
        }
        held += kept[i] ? 1 : 0;
    }
    EXPECT_GT(held, 0u);
    EXPECT_GE(static_cast<double>(moved), 0.99 * static_cast<double>(others));
    std::cout << held << " vertices kept, " << moved << " of " << others << " others moved\n";
    EXPECT_EQ(before.polygons().corners, after.polygons().corners);
}

/// Returns `document` with a property `chosen` of the faces: 1 in the lower half of the longest
/// axis.
std::string with_lower_half_chosen(const FileDocument& document, Marks& kept) {
    Eigen::AlignedBox<double, 3> box;
    const Marks used = used_vertices(document);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i]) box.extend(document.positions()[i]);
    }
    int axis;
    box.sizes().maxCoeff(&axis);
    const Polygons& polygons = document.polygons();
    std::ostringstream text;
    text << "ply\nformat binary_little_endian 1.0\nelement vertex " << used.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
         << polygons.size()
         << "\nproperty list uchar int vertex_indices\nproperty uchar chosen\nend_header\n";
    for (const Eigen::Vector3d& p : document.positions()) text << packed(p.x(), p.y(), p.z());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const std::int32_t* const corner = &polygons.corners[polygons.first[i]];
        const auto at = [&](int k) {
            return document.positions()[static_cast<std::size_t>(corner[k])][axis];
        };
        const bool chosen = (at(0) + at(1) + at(2)) / 3 < box.center()[axis];
        for (int k = 0; !chosen && k < 3; ++k) kept[static_cast<std::size_t>(corner[k])] = true;
        text << packed(std::uint8_t{3}, corner[0], corner[1], corner[2],
                       static_cast<std::uint8_t>(chosen));
    }
    return text.str();
}

/// A bumpy square with a seam of duplicate vertices. The seam is not a boundary.
std::string bumpy_square() {
    constexpr int n = 40;
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << 2 * n * n
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
         << 2 * (2 * n - 2) * (n - 1) << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int half = 0; half < 2; ++half) {
        for (int i = 0; i < n * n; ++i) {
            const int x = i % n + half * (n - 1), y = i / n;
            text << x << ' ' << y << ' ' << (x * 7 + y * 13) % 5 * 0.1 << '\n';
        }
    }
    for (int half = 0; half < 2; ++half) {
        for (int i = half * n * n; i < (half + 1) * n * n - n; ++i) {
            if (i % n == n - 1) continue;
            text << "3 " << i << ' ' << i + 1 << ' ' << i + n + 1 << "\n3 " << i << ' ' << i + n + 1
                 << ' ' << i + n << '\n';
        }
    }
    return text.str();
}

/// The name of a scan, or nothing for the square.
class Kept : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        if (GetParam().empty()) {
            write_file(folder_ / "in.ply", bumpy_square());
            return;
        }
        const auto path = std::filesystem::path(TRACKED_MCF_SHARED_MESHES) / (GetParam() + ".ply");
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
        std::filesystem::copy_file(path, folder_ / "in.ply");
    }

    std::unique_ptr<FileDocument> smoothed(const std::string& options) const {
        const ProgramRun run = run_program(folder_, "in.ply out.ply --quiet " + options);
        EXPECT_EQ(run.exit_code, 0) << run.errors;
        return open_document(folder_ / "out.ply");
    }

    TemporaryFolder folder_;
};

TEST_P(Kept, ALockedBoundaryKeepsItsBits) {
    const auto before = open_document(folder_ / "in.ply");
    for (const char* flow : {"mean-curvature", "conformalized"}) {
        const auto after = smoothed("--detail-size 5% --iterations 5 --flow " + std::string(flow));
        expect_kept(*before, *after, boundary_vertices(*before));
    }
}

TEST_P(Kept, UnselectedVerticesKeepTheirBits) {
    Marks kept = boundary_vertices(*open_document(folder_ / "in.ply"));
    write_file(folder_ / "in.ply",
               with_lower_half_chosen(*open_document(folder_ / "in.ply"), kept));
    const auto before = open_document(folder_ / "in.ply");
    expect_kept(*before, *smoothed("--detail-size 5% --iterations 5 --selected chosen"),
                with_twins(kept, before->positions()));
}

INSTANTIATE_TEST_SUITE_P(OpenMeshes, Kept,
                         ::testing::Values("", "stanford_bunny", "demosthenes_8k", "mannequin_11k",
                                           "laurana50k", "angel_scan"),
                         [](const auto& test) {
                             return test.param.empty() ? "bumpy_square" : test.param;
                         });

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
