// SPDX-License-Identifier: GPL-3.0-or-later
/// The program as a whole: exit codes, streams, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/cli/command_line.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/program_fixture.h"
#include "tests/support/values_outside.h"

namespace tracked_mcf {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pointwise;
using ::testing::StartsWith;

/// Returns all numbers in an OFF file.
std::vector<double> numbers_in(const std::string& off) {
    std::istringstream text(off);
    std::string word;
    text >> word;
    std::vector<double> numbers;
    for (double number = 0; text >> number;) numbers.push_back(number);
    return numbers;
}

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
    EXPECT_THAT(run("a.off b.ply --depth 4 --step-size 5e-4 --verbose").output,
                AllOf(HasSubstr("\nGrid of depth 4: "), HasSubstr("\nStep size 0.0005, ")));
}

TEST_F(Program, TakesTheFlowWithAndWithoutItsCommand) {
    EXPECT_EQ(run("a.off b.off --quiet").exit_code, 0);
    EXPECT_EQ(run("smooth a.off c.off --quiet").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "b.off"), read_file(folder_ / "c.off"));
    for (const char* command : {"smooth", "remove-noise", "fair"})
        EXPECT_THAT(run("--help").output, HasSubstr("\n  " + std::string(command) + " "));
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

TEST_F(Program, QuietSaysNothing) {
    const ProgramRun result = run("a.off b.ply --depth 3 --step-size 1e-5 --quiet");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_THAT(result.errors, IsEmpty());
}

TEST_F(Program, ATightToleranceIsReached) {
    write_file(folder_ / "grid.off", grid(20));
    const ProgramRun result =
        run("grid.off b.ply --boundary free --tolerance 1e-10 --iterations 2 --report r.json");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, IsEmpty());
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\"tolerance\": 1e-10"));
    EXPECT_THAT(read_file(folder_ / "r.json"), Not(HasSubstr("\"reached_tolerance\": false")));
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

TEST_F(Program, TheDetailSizeIsOneOfTheTwoWaysToGiveTheStepSize) {
    const auto positions = [&](const std::string& options) {
        const ProgramRun result = run("a.off b.off --order 1 --depth 4 --iterations 1 " + options);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return numbers_in(read_file(folder_ / "b.off"));
    };
    // One step of order 1 halves waves of length 2 pi sqrt(delta).
    EXPECT_THAT(positions("--detail-size 0.6283185307179586"),
                Pointwise(DoubleNear(1e-12), positions("--step-size 0.01")));
    EXPECT_EQ(positions("--detail-size 5 --step-size 0.01"), positions("--step-size 0.01"));
    EXPECT_NE(positions("--detail-size 5"), positions("--step-size 0.01"));
}

TEST_F(Program, AreaOrVolumeIsPreserved) {
    const auto kept = [&](const char* name, auto measure) {
        const ProgramRun result =
            run("a.off b.off --depth 5 --step-size 1e-2 --iterations 50 "
                "--preserve " +
                std::string(name));
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        const double before = measure(MeshFile(folder_ / "a.off").triangle_mesh());
        EXPECT_NEAR(measure(MeshFile(folder_ / "b.off").triangle_mesh()), before, 1e-6 * before);
    };
    kept("area", [](const TriangleMesh& mesh) { return surface_area(mesh); });
    kept("volume", [](const TriangleMesh& mesh) { return enclosed_volume(mesh); });
}

TEST_F(Program, WhatCannotBePreservedIsRefused) {
    write_file(folder_ / "grid.off", grid(5));
    write_file(folder_ / "twisted.off",
               "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2\n3 0 3 2\n");
    const auto refuses = [&](const std::string& arguments, int code, const char* message) {
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_THAT(result.errors, HasSubstr(message)) << arguments;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply")) << arguments;
    };
    refuses("grid.off b.ply --boundary free --flow conformalized --preserve volume", 1,
            "A conformalized flow cannot preserve the volume because the surface is open");
    refuses("grid.off b.ply --flow conformalized --preserve volume", 2,
            "Preserving the volume of a conformalized flow would move vertices that must stay");
    refuses("grid.off b.ply --preserve area", 2,
            "Preserving the area would move vertices that must stay");
    refuses("twisted.off b.ply --preserve volume", 1,
            "The volume cannot be preserved because the faces are not oriented consistently");
}

TEST_F(Program, TheQualityIsAPropertyOfThePlyFile) {
    const auto quality = [&](const std::string& option) {
        EXPECT_EQ(run("a.off b.ply --depth 4 --step-size 1e-4 " + option).exit_code, 0);
        return MeshFile(folder_ / "b.ply").numbers_by("quality");
    };
    EXPECT_THROW(quality(""), InvalidParameter);
    // All corners of the tetrahedron stand out and move in.
    const auto displacement = quality("--quality displacement");
    const auto curvature = quality("--quality mean-curvature");
    ASSERT_EQ(displacement.size(), 4U);
    ASSERT_EQ(curvature.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LT(displacement[i], 0);
        EXPECT_GT(curvature[i], 0);
    }
}

TEST_F(Program, AFlowThatVanishesStopsWithAWarningAndItsLastGoodPositions) {
    const ProgramRun result =
        run("a.off b.ply --depth 4 --step-size 0.1 --iterations 100 --report r.json --quiet");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_THAT(result.errors, StartsWith("tracked_mcf: warning: The flow stopped after step "));
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\"stop\": \"vanished\""));
    EXPECT_GT(area("b.ply"), 0);
}

TEST_F(Program, AMeshThatCannotMoveIsAWarning) {
    write_file(folder_ / "grid.off", grid(5));
    const ProgramRun result = run("grid.off b.off --depth 1 --method paper");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(
        result.errors,
        "tracked_mcf: warning: Nothing has moved: all of the surface is constrained. Free the "
        "boundary, or select more; with the method Paper, take a greater depth.\n");
    EXPECT_THAT(result.output, AllOf(StartsWith("Smoothed 25 vertices by 0 steps of "),
                                     HasSubstr("\n16 vertices kept their positions.\n")));
}

TEST_F(Program, DetailFinerThanTheMeshIsAWarningAndAddsNoDepth) {
    write_file(folder_ / "grid.off", grid(20));
    const ProgramRun fine = run("grid.off b.ply --detail-size 1% --report fine.json");
    EXPECT_THAT(fine.errors, StartsWith("tracked_mcf: warning: The detail size is 0.2"));
    EXPECT_THAT(fine.errors, HasSubstr(" mean edges; below 2 little changes. The default is 3 "));
    ASSERT_EQ(run("grid.off b.ply --detail-size 0.001% --report finer.json").exit_code, 0);
    const auto depth_of = [&](const char* report) {
        const std::string text = read_file(folder_ / report);
        return text.substr(text.find("\n  \"depth\": "), 13);
    };
    EXPECT_EQ(depth_of("finer.json"), depth_of("fine.json"));
}

TEST_F(Program, ReplacesItsInputWhenAsked) {
    const double before = area("a.off");
    EXPECT_EQ(run("a.off a.off --order 1 --depth 4 --step-size 1e-3").exit_code, 0);
    EXPECT_LT(area("a.off"), 0.99 * before);
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

TEST_F(Program, EmptyValuesAreRefused) {
    for (const char* option : {"--detail-size", "--order", "--depth", "--step-size", "--iterations",
                               "--flow", "--boundary", "--selected", "--preserve", "--quality",
                               "--method", "--tolerance", "--threads", "--report"}) {
        const ProgramRun result = run("a.off b.ply " + std::string(option) + " \"\"");
        EXPECT_EQ(result.exit_code, 2) << option;
        EXPECT_THAT(result.errors, HasSubstr(option));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply")) << option;
    }
}

/// Runs the program with options that its command must refuse.
template <class Parameters, class Run>
void expect_refused_outside_the_ranges(const std::string& command, const Run& run) {
    for (const ParameterOf<Parameters>& row : parameter_table<Parameters>()) {
        std::vector<std::string> values = {"x"};
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
          "a.off \"\"", "a.off b.ply --report b.ply", "fair a.off b.ply"}) {
        const ProgramRun result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_EQ(result.errors.substr(0, 13), "tracked_mcf: ") << arguments;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply")) << arguments;
    }
    EXPECT_THAT(run("a.off b.ply --depth 99").errors, HasSubstr("depth is 99; give 0 to 12"));
    EXPECT_THAT(run("a.off b.ply --order 5").errors, HasSubstr("order is 5; give 1 to 4."));
    EXPECT_THAT(
        run("a.off b.ply --detail-size -1").errors,
        HasSubstr("--detail-size is -1; give 0 or more, in units of the mesh, where 0 takes 3 "
                  "mean edge lengths."));
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
