// SPDX-License-Identifier: GPL-3.0-or-later
/// The program as a whole: exit codes, streams, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/cli/command_line.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/program_fixture.h"
#include "tests/support/values_outside.h"

namespace tracked_mcf {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

using Program = ProgramFixture;

TEST_F(Program, SmoothsAndSummarises) {
    const ProgramRun result =
        run("a.off b.ply --order 1 --depth 4 --step-size 5e-4 --iterations 3");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, IsEmpty()) << "no progress bar where there is no terminal";
    EXPECT_THAT(result.output,
                StartsWith("Smoothed 4 vertices by 3 steps of mean-curvature flow in "));
    EXPECT_THAT(result.output, EndsWith("b.ply was written.\n"));
    EXPECT_THAT(result.output, Not(HasSubstr("depth")));
    EXPECT_LT(area("b.ply"), 0.99 * area("a.off"));
}

TEST_F(Program, VerboseTellsTheNumbersOfTheSolver) {
    EXPECT_THAT(run("a.off b.ply --depth 4 --method paper --step-size 5e-4 --verbose").output,
                AllOf(HasSubstr("\nGrid of depth 4: "), HasSubstr("\nStep size 0.0005, ")));
    EXPECT_THAT(run("a.off b.ply --depth 4 --step-size 5e-4 --verbose").output,
                AllOf(Not(HasSubstr("Grid")), HasSubstr("\nStep size 0.0005, ")))
        << "four vertices need no octree";
}

TEST_F(Program, TakesTheFlowWithAndWithoutItsCommand) {
    EXPECT_EQ(run("a.off b.off --quiet").exit_code, 0);
    EXPECT_EQ(run("smooth a.off c.off --quiet").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "b.off"), read_file(folder_ / "c.off"));
    for (const char* command : {"smooth", "remove-noise", "fair"})
        EXPECT_THAT(run("--help").output, HasSubstr("\n  " + std::string(command) + " "));
}

TEST_F(Program, ReplacesNoOtherMeshUnlessAskedTo) {
    write_file(folder_ / "b.off", grid(3));
    const ProgramRun refused = run("a.off b.off");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.errors,
                AllOf(HasSubstr("b.off exists and is another mesh, of 9 vertices and 4 faces where "
                                "INPUT has 4 vertices and 4 faces"),
                      HasSubstr("--overwrite")));
    EXPECT_EQ(read_file(folder_ / "b.off"), grid(3));
    EXPECT_EQ(run("a.off b.off --overwrite --quiet").exit_code, 0);
    EXPECT_EQ(run("a.off b.off --quiet").exit_code, 0) << "a version of INPUT";
    EXPECT_EQ(run("a.off b.stl --quiet").exit_code, 0);
    EXPECT_EQ(run("a.off b.stl --quiet").exit_code, 0) << "STL has the vertices of each triangle";
    write_file(folder_ / "c.off", "no mesh");
    EXPECT_EQ(run("a.off c.off --quiet").exit_code, 0);
    EXPECT_THAT(run("a.off b.off c.off").errors, HasSubstr("tracked_mcf_folder"));
}

TEST_F(Program, AMisspeltCommandIsNamed) {
    for (const auto& [typed, meant] :
         {std::pair{"remove_noise", "remove-noise"}, std::pair{"RemoveNoise", "remove-noise"},
          std::pair{"Fair", "fair"}, std::pair{"smoth", "smooth"}}) {
        const ProgramRun result = run(std::string(typed) + " a.off b.ply");
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_EQ(result.errors, "tracked_mcf: unknown command " + std::string(typed) +
                                     "; did you mean " + meant + "?\n");
    }
    write_file(folder_ / "fair.off", kTetrahedron);
    EXPECT_EQ(run("fair.off b.ply --quiet").exit_code, 0) << "a file may have the name";
}

TEST_F(Program, AToleranceThatIsNotReachedIsAWarningEvenWhenQuiet) {
    // Beyond double precision.
    const ProgramRun result = run(
        "a.off b.ply --depth 4 --step-size 1e-5 --tolerance 1e-30 --iterations 2 --report r.json "
        "--quiet");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_THAT(result.errors,
                StartsWith("tracked_mcf: warning: The solver stopped short of the tolerance 1e-30 "
                           "in 2 of 2 steps: the worst is step "));
    EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << "one line";
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\"reached_tolerance\": false"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "b.ply"));
}

TEST_F(Program, ADetailSizeInPerCentIsPartOfTheBoxesDiagonal) {
    // The vertex far away has no face, and is no part of the box.
    write_file(folder_ / "far.off",
               "OFF\n5 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 7\n1e9 0 0\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
               "3 1 2 3\n");
    const auto positions = [&](const std::string& options) {
        const ProgramRun result = run("far.off b.off --depth 4 --report r.json " + options);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return read_file(folder_ / "b.off");
    };
    const std::string absolute = positions("--detail-size 1.375");
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\n    \"detail_size\": 1.375,\n"));
    EXPECT_EQ(positions("--detail-size 12.5%"), absolute);
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\n    \"detail_size\": 1.375,\n"));
    EXPECT_NE(positions("--detail-size 12.5"), absolute);
    EXPECT_EQ(positions("--detail-size 0%"), positions(""));
}

TEST_F(Program, NamesOfOtherFilesStayInEveryFolder) {
    std::filesystem::create_directory(folder_ / "out");
    write_file(folder_ / "a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    ASSERT_EQ(run("a.obj out/b.obj --depth 3").exit_code, 0);
    EXPECT_THAT(read_file(folder_ / "out/b.obj"), StartsWith("mtllib m.mtl\nv "));
}

TEST_F(Program, HelpAndVersionSucceed) {
    EXPECT_EQ(run("--help").exit_code, 0);
    EXPECT_EQ(run("--version").output, "tracked_mcf " TRACKED_MCF_VERSION "\n");
}

/// Runs the program with options that its command must refuse.
template <class Parameters, class Run>
void expect_refused_outside_the_ranges(const std::string& command, const Run& run) {
    for (const ParameterOf<Parameters>& row : parameter_table<Parameters>()) {
        std::vector<std::string> values = {"x", "\"\""};
        for (const ParameterValue& value : values_outside(row)) {
            if (row.type == Parameter::Type::Choice) break;  // by name
            std::ostringstream text;
            std::visit([&](auto number) { text << number; }, value);
            values.push_back(text.str());
        }
        const std::string option = option_of(row.name);
        if (row.type == Parameter::Type::Switch) continue;
        for (const std::string& value : values) {
            std::ostringstream arguments;
            arguments << command << " a.ply b.ply " << option << ' ' << value;
            const ProgramRun result = run(arguments.str());
            EXPECT_EQ(result.exit_code, 2) << arguments.str();
            EXPECT_THAT(result.errors, HasSubstr(option)) << arguments.str();
        }
    }
}

TEST_F(Program, WhatIsOutsideTheRangesIsRefusedAndNamed) {
    const auto run_here = [&](const std::string& arguments) { return run(arguments); };
    write_file(folder_ / "a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "property int flags\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 32\n");
    expect_refused_outside_the_ranges<FlowParameters>("smooth", run_here);
    expect_refused_outside_the_ranges<NoiseParameters>("remove-noise", run_here);
    expect_refused_outside_the_ranges<FairParameters>("fair --selected flags", run_here);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply"));
}

TEST_F(Program, WrongUseExitsWith2) {
    for (const char* arguments :
         {"", "a.off", "a.off b.ply --detail-size -1%", "a.off b.ply --detail-size %",
          "a.off b.ply --detail-size inf%", "a.off b.ply --detail-size",
          "a.off b.off --quality displacement", "a.off b.ply --method paper --flow conformalized",
          "a.off b.ply --rescale volume", "a.off b.ply --selected flags", "a.off b.xyz",
          "a.off \"\"", "a.off b.ply --report b.ply", "a.off b.ply --report \"\"",
          "fair a.off b.ply"}) {
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_EQ(result.errors.substr(0, 13), "tracked_mcf: ") << arguments;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply")) << arguments;
    }
    EXPECT_THAT(run("a.off b.ply --detail_size 1").errors,
                HasSubstr("Do you mean --detail-size? Run"));
    EXPECT_THAT(run("a.off b.ply --iter=2").errors, HasSubstr("Do you mean --iterations? Run"));
    EXPECT_THAT(run("a.off b.ply --unlike-any").errors, HasSubstr("--unlike-any. Run"));
}

TEST_F(Program, UnwritableResultsExitWith3BeforeTheWork) {
    for (const char* arguments : {"a.off missing/b.ply", "a.off b.ply --report missing/r.json"}) {
        // An endless job: the test would time out if it were begun.
        const ProgramRun result = run(std::string(arguments) + " --iterations 1000000 --depth 9");
        EXPECT_EQ(result.exit_code, 3) << arguments;
        EXPECT_THAT(result.errors, HasSubstr("tracked_mcf: cannot write ")) << arguments;
    }
}

TEST_F(Program, NamesMayHaveAnyLetters) {
    // "Fläche", "曲面" and "отчёт", spelled so that every compiler takes these bytes.
    const std::string input =
                          "Fl\xC3\xA4"
                          "che.off",
                      output = "\xE6\x9B\xB2\xE9\x9D\xA2.ply";
    const std::string report = "\xD0\xBE\xD1\x82\xD1\x87\xD1\x91\xD1\x82.json";
    std::filesystem::rename(folder_ / "a.off", folder_ / input);
    const ProgramRun result = run(input + " " + output + " --depth 3 --report " + report);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("\n" + output + " was written."));
    EXPECT_LT(area(output), 0.99 * area(input));
    EXPECT_THAT(read_file(folder_ / report), HasSubstr("\"" + output + "\""));
    EXPECT_THAT(run(output + "x b.ply").errors, HasSubstr(output + "x: the extension"));
}

}  // namespace
}  // namespace tracked_mcf
