// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;

CommandLineOf<FlowParameters> parse(const std::vector<const char*>& arguments) {
    return parse_command_line<FlowParameters>({arguments.begin(), arguments.end()});
}

std::string complaint(const std::vector<const char*>& arguments) {
    try {
        parse(arguments);
    } catch (const InvalidParameter& error) {
        return error.what();
    }
    return "none";
}

/// Returns the text without line breaks and indentation.
std::string unwrapped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const char letter = c == '\n' ? ' ' : c;
        if (letter != ' ' || result.empty() || result.back() != ' ') result += letter;
    }
    return result;
}

TEST(CommandLine, DefaultsAreThoseOfTheFlow) {
    const auto line = parse({"a.ply", "b.stl"});
    const FlowParameters defaults;
    EXPECT_EQ(line.input, "a.ply");
    EXPECT_EQ(line.output, "b.stl");
    EXPECT_EQ(line.report, "");
    EXPECT_FALSE(line.quiet);
    EXPECT_TRUE(line.lengths.empty());
    EXPECT_EQ(line.parameters.detail_size, defaults.detail_size);
    EXPECT_EQ(line.parameters.order, defaults.order);
    EXPECT_EQ(line.parameters.depth, defaults.depth);
    EXPECT_EQ(line.parameters.step_size, defaults.step_size);
    EXPECT_EQ(line.parameters.iterations, defaults.iterations);
    EXPECT_EQ(line.parameters.flow, defaults.flow);
    EXPECT_EQ(line.parameters.boundary, defaults.boundary);
    EXPECT_EQ(line.properties.at("selected"), "");
    EXPECT_EQ(line.parameters.preserve, defaults.preserve);
    EXPECT_EQ(line.parameters.method, defaults.method);
    EXPECT_EQ(line.parameters.tolerance, defaults.tolerance);
    EXPECT_EQ(line.parameters.threads, defaults.threads);
}

TEST(CommandLine, EveryOptionIsTaken) {
    const auto line = parse({"a.PLY",
                             "b.Stl",
                             "--detail-size",
                             "0.75%",
                             "--order",
                             "4",
                             "--depth",
                             "7",
                             "--step-size",
                             "2.5e-4",
                             "--iterations=3",
                             "--flow",
                             "conformalized",
                             "--boundary",
                             "free",
                             "--selected",
                             "my quality",
                             "--preserve",
                             "Volume",
                             "--method",
                             "paper",
                             "--tolerance",
                             "1e-10",
                             "--threads",
                             "2",
                             "--report",
                             "r.json",
                             "--quiet"});
    EXPECT_EQ(line.lengths.at("detail_size").value, 0.75);
    EXPECT_TRUE(line.lengths.at("detail_size").in_per_cent);
    EXPECT_EQ(line.parameters.order, 4);
    EXPECT_EQ(line.parameters.depth, 7);
    EXPECT_EQ(line.parameters.step_size, 2.5e-4);
    EXPECT_EQ(line.parameters.iterations, 3);
    EXPECT_EQ(line.parameters.flow, FlowKind::Conformalized);
    EXPECT_EQ(line.parameters.boundary, BoundaryCondition::Free);
    EXPECT_EQ(line.properties.at("selected"), "my quality");
    EXPECT_EQ(line.parameters.preserve, Preserve::Volume);
    EXPECT_EQ(line.parameters.method, Method::Paper);
    EXPECT_EQ(line.parameters.tolerance, 1e-10);
    EXPECT_EQ(line.parameters.threads, 2);
    EXPECT_EQ(line.report, "r.json");
    EXPECT_TRUE(line.quiet);
}

TEST(CommandLine, EveryValueOfAChoiceHasTheNameThatSelectsIt) {
    const auto value = [](const ParameterOf<FlowParameters>& parameter, const std::string& name) {
        const std::string option = "--" + parameter.name;
        return parameter.get(parse({"a.ply", "b.ply", option.c_str(), name.c_str()}).parameters);
    };
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
            const std::string& name = parameter.choices[i].name;
            EXPECT_EQ(value(parameter, name), ParameterValue(static_cast<int>(i))) << name;
        }
    }
}

TEST(CommandLine, ALengthIsInUnitsOfTheMeshOrInPerCent) {
    const auto length = [](const char* text) {
        return parse({"a.ply", "b.ply", "--detail-size", text}).lengths.at("detail_size");
    };
    const auto expect = [&](const char* text, double value, bool in_per_cent) {
        EXPECT_EQ(length(text).value, value) << text;
        EXPECT_EQ(length(text).in_per_cent, in_per_cent) << text;
    };
    expect("1.5", 1.5, false);
    expect("2e-3", 2e-3, false);
    expect("0", 0, false);
    expect("0.5%", 0.5, true);
    expect("1e2%", 100, true);
    expect("0%", 0, true);
}

TEST(CommandLine, WhatIsNoLengthIsRefusedWithTwoExamples) {
    for (const char* text : {"%", "x", "1.5mm", "1.5 %%", "5%%", "0,5%", "% 5", "1.5 2"}) {
        EXPECT_THAT(complaint({"a.ply", "b.ply", "--detail-size", text}),
                    HasSubstr("--detail-size: give a length such as 1.5, or 2% of the bounding "
                              "box's diagonal. Run tracked_mcf --help."))
            << text;
    }
}

TEST(CommandLine, OnlyAPlyHasPropertiesToSelectBy) {
    EXPECT_THAT(complaint({"a.obj", "b.ply", "--selected", "q"}),
                HasSubstr("--selected needs a PLY file as INPUT"));
    EXPECT_EQ(complaint({"a.Ply", "b.stl", "--selected", "q"}), "none");
    EXPECT_THAT(complaint({"a.ply", "b.stl", "--selected", ""}), HasSubstr("--selected"));
}

TEST(CommandLine, InvalidArgumentsAreNamed) {
    EXPECT_THAT(complaint({"a.ply"}), HasSubstr("OUTPUT is required"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--iterations", "abc"}),
                HasSubstr("--iterations = abc"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--iterations", "2.5"}),
                HasSubstr("--iterations = 2.5"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--depth", "99999999999"}), HasSubstr("--depth"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--rescale", "volume"}), HasSubstr("--rescale"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--order", "1.5"}), HasSubstr("--order = 1.5"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--speed", "2"}), HasSubstr("--speed"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "c.ply"}), HasSubstr("c.ply"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--bad"}), HasSubstr("tracked_mcf --help"));
}

TEST(CommandLine, TheExtensionTellsTheFormat) {
    EXPECT_EQ(complaint({"a.ply", "b.xyz"}),
              "b.xyz: the extension tells the format; give .ply, .obj, .off or .stl.");
    EXPECT_EQ(complaint({"scan", "b.ply"}),
              "scan: the extension tells the format; give .ply, .obj, .off or .stl.");
    EXPECT_EQ(complaint({"a.ply", "b.obj"}),
              "b.obj: only PLY and STL can be written from another format; give OUTPUT the "
              "extension of INPUT, .ply or .stl.");
}

TEST(CommandLine, TheReportMustNotReplaceAMesh) {
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--report", "./b.ply"}),
                HasSubstr("--report would overwrite the mesh b.ply"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--report", "a.ply"}),
                HasSubstr("--report would overwrite the mesh a.ply"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "--report", "c.ply"}),
                HasSubstr("--report would write JSON to c.ply"));
    EXPECT_THAT(complaint({"a.ply", "b.ply", "c.ply", "d.ply"}),
                HasSubstr("not expected: c.ply d.ply."));
}

TEST(CommandLine, HelpNamesEveryOptionAndExplainsTheSharedParameters) {
    const std::string help = parse({"--help"}).answer;
    for (const char* option : {"INPUT",
                               "OUTPUT",
                               "--detail-size X|X%",
                               "--order",
                               "--depth",
                               "--step-size",
                               "--iterations",
                               "--flow",
                               "mean-curvature|conformalized",
                               "--boundary",
                               "locked|free",
                               "--selected",
                               "PROPERTY",
                               "--preserve",
                               "none|area|volume",
                               "--method",
                               "converged|paper",
                               "--tolerance",
                               "--threads",
                               "--report",
                               "--quiet",
                               "--version",
                               "--help",
                               "Examples:",
                               "Exit codes:",
                               "PLY, OBJ, OFF and STL"}) {
        EXPECT_THAT(help, HasSubstr(option));
    }
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        EXPECT_THAT(unwrapped(help), HasSubstr(parameter.help)) << parameter.name;
    }
    // The labels of fields, such as "Detail size (0: auto)", are for dialogs.
    EXPECT_THAT(unwrapped(help), Not(HasSubstr("(0: ")));
}

TEST(CommandLine, HelpFitsIntoAHundredColumns) {
    std::size_t column = 0;
    for (const char c : parse({"--help"}).answer) {
        column = c == '\n' ? 0 : column + 1;
        ASSERT_LE(column, 100u);
    }
}

TEST(CommandLine, VersionIsTheProjects) {
    EXPECT_EQ(parse({"--version"}).answer, "tracked_mcf " TRACKED_MCF_VERSION "\n");
}

}  // namespace
}  // namespace tracked_mcf
