// SPDX-License-Identifier: GPL-3.0-or-later
/// What all commands of the program do alike, with each of them.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

#include "filter_tracked_mcf/hosts/cli/command_line.h"
#include "filter_tracked_mcf/hosts/cli/documents/polygons.h"
#include "tests/cli/program_fixture.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr int kSide = 20;

/// A noisy wave of 20 x 20 vertices. Its vertices and faces have numbers; `inner` is 1 at the faces
/// in the middle.
std::string wave() {
    std::ostringstream ply;
    ply << "ply\nformat ascii 1.0\ncomment a wave\nelement vertex " << kSide * kSide
        << "\nproperty double x\nproperty double y\nproperty double z\nproperty int number\n"
        << "element face " << 2 * (kSide - 1) * (kSide - 1)
        << "\nproperty list uchar int vertex_indices\nproperty uchar inner\nend_header\n";
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.2);
    for (int i = 0; i < kSide * kSide; ++i) {
        const int x = i % kSide, y = i / kSide;
        ply << x << ' ' << y << ' ' << std::sin(0.3 * x) + noise(random) << ' ' << 1000 + i << '\n';
    }
    const auto is_inner = [](int at) { return at > 2 && at < 17; };
    for (int i = 0; i < kSide * (kSide - 1); ++i) {
        if (i % kSide == kSide - 1) continue;
        const int inner = is_inner(i % kSide) && is_inner(i / kSide) ? 1 : 0;
        ply << "3 " << i << ' ' << i + 1 << ' ' << i + kSide + 1 << ' ' << inner << "\n3 " << i
            << ' ' << i + kSide + 1 << ' ' << i + kSide << ' ' << inner << '\n';
    }
    return ply.str();
}

class EachCommand : public ProgramFixture, public ::testing::WithParamInterface<Command> {
protected:
    void SetUp() override { write_file(folder_ / "wave.ply", wave()); }

    /// Runs the command on the wave.
    ProgramRun run_on_wave(const std::string& output_and_options) const {
        const std::string name = GetParam().name;
        return run(name + " wave.ply " + output_and_options +
                   (name == "fair" ? " --selected inner" : ""));
    }
};

INSTANTIATE_TEST_SUITE_P(Commands, EachCommand, ::testing::ValuesIn(kCommands),
                         [](const auto& tested) {
                             std::string name = tested.param.name;
                             name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                             return name;
                         });

TEST_P(EachCommand, ChangesPositionsAlone) {
    const ProgramRun result = run_on_wave("out.ply");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("out.ply was written.\n"));
    const std::vector<std::string> before = words_of(wave()),
                                   after = words_of(read_file(folder_ / "out.ply"));
    ASSERT_EQ(after.size(), before.size());
    const auto header = std::find(before.begin(), before.end(), "end_header") - before.begin();
    std::set<std::ptrdiff_t> changed;  // columns of the vertices
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (after[i] == before[i]) continue;
        const std::ptrdiff_t word = static_cast<std::ptrdiff_t>(i) - header - 1;
        ASSERT_TRUE(word >= 0 && word < 4 * kSide * kSide) << before[i] << ' ' << after[i];
        changed.insert(word % 4);
    }
    EXPECT_THAT(changed, ::testing::IsSubsetOf({0, 1, 2}));
    EXPECT_THAT(changed, ::testing::Contains(2));
}

TEST_P(EachCommand, KeepsTheBitsOfWhatStays) {
    const bool is_fair = GetParam().name == std::string("fair");
    const Points before = MeshFile(folder_ / "wave.ply").triangle_mesh().positions;
    const auto expect_only_moved = [&](const std::string& options, int first, int end) {
        ASSERT_EQ(run_on_wave("out.ply " + options).exit_code, 0);
        const Points after = MeshFile(folder_ / "out.ply").triangle_mesh().positions;
        for (int i = 0; i < kSide * kSide; ++i) {
            const auto is_inside = [&](int at) { return at >= first && at < end; };
            const bool moves = is_inside(i % kSide) && is_inside(i / kSide);
            EXPECT_EQ(after[std::size_t(i)] != before[std::size_t(i)], moves) << options << i;
        }
    };
    expect_only_moved(is_fair ? "" : "--selected inner", 4, 17);
    if (!is_fair) expect_only_moved("--boundary locked", 1, kSide - 1);
}

TEST_P(EachCommand, ConvertsToStl) {
    ASSERT_EQ(run_on_wave("out.ply --quiet").exit_code, 0);
    const ProgramRun result = run_on_wave("out.stl --quiet");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("does not keep everything of"));
    EXPECT_NEAR(area("out.stl"), area("out.ply"), 1e-5 * area("out.ply"));
}

TEST_P(EachCommand, ReplacesItsInput) {
    ASSERT_EQ(run_on_wave("out.ply").exit_code, 0);
    ASSERT_EQ(run_on_wave("wave.ply").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "wave.ply"), read_file(folder_ / "out.ply"));
}

TEST_P(EachCommand, HasTheSameBytesForAnyNumberOfThreads) {
    ASSERT_EQ(run_on_wave("one.ply --threads 1").exit_code, 0);
    ASSERT_EQ(run_on_wave("three.ply --threads 3").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "one.ply"), read_file(folder_ / "three.ply"));
}

TEST_P(EachCommand, ReportsWhatItHasDone) {
    ASSERT_EQ(run_on_wave("out.ply --report r.json").exit_code, 0);
    const auto report = nlohmann::json::parse(read_file(folder_ / "r.json"));
    EXPECT_EQ(report["program"], "tracked_mcf");
    EXPECT_EQ(report["parameters"]["threads"], 0);
    EXPECT_TRUE(report["warnings"].is_array());
    const bool is_fair = GetParam().name == std::string("fair");
    EXPECT_EQ(report["triangles"], is_fair ? 392 : 722);
    EXPECT_EQ(report["vertices"], is_fair ? 169 : 400);
    const double area_after = report["area_after"];
    if (!is_fair) {
        EXPECT_NEAR(area_after, area("out.ply"), 1e-9 * area_after);
    }
    EXPECT_LT(area_after, report["area_before"]);
    EXPECT_GT(report["largest_displacement"], report["rms_displacement"]);
    EXPECT_GT(report["rms_displacement"], 0);
}

TEST_P(EachCommand, QuietSaysNothing) {
    const ProgramRun result = run_on_wave("out.ply --quiet --largest-movement 1");
    // Only one of the commands has this option.
    EXPECT_EQ(result.exit_code, GetParam().name == std::string("remove-noise") ? 0 : 2);
    EXPECT_THAT(result.output, IsEmpty());
}

TEST_P(EachCommand, LeavesTheOutputIfSomethingIsWrong) {
    write_file(folder_ / "out.ply", "before");
    write_file(folder_ / "cut.ply", wave().substr(0, 2000));
    const std::string name = GetParam().name;
    const auto expect_refused = [&](const std::string& arguments, int code, const char* message) {
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_THAT(result.errors, StartsWith("tracked_mcf: "));
        EXPECT_THAT(result.errors, HasSubstr(message));
        EXPECT_THAT(result.output, IsEmpty());
        EXPECT_EQ(read_file(folder_ / "out.ply"), "before") << arguments;
    };
    for (const auto& [files, code, message] :
         {std::tuple{" none.ply out.ply", 1, "cannot read none.ply"},
          std::tuple{" cut.ply out.ply", 1, "cut.ply cannot be used: "},
          std::tuple{" wave.ply out.ply --tthreads 2", 2, "Do you mean --threads?"},
          std::tuple{" wave.ply out.ply --threads -1", 2, "--threads "},
          std::tuple{" wave.ply no/out.ply", 3, "no/out.ply"}}) {
        std::string arguments = name + files;
        if (name == "fair") arguments += " --selected inner";
        expect_refused(arguments, code, message);
    }
    expect_refused(name + " wave.ply out.ply --selected outer", 2, "has no number 'outer'");
}

}  // namespace
}  // namespace tracked_mcf
