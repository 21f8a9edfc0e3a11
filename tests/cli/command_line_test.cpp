// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;

CommandLineOf<FlowParameters> parse(const std::vector<std::string>& arguments) {
    return parse_command_line<FlowParameters>(arguments);
}

CommandLineOf<FlowParameters> parse(const std::string& line) {
    return parse(words_of(line));
}

std::string complaint(const std::vector<std::string>& arguments) {
    try {
        parse(arguments);
    } catch (const InvalidParameter& error) {
        return error.what();
    }
    return "none";
}

std::string complaint(const std::string& line) {
    return complaint(words_of(line));
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
    const auto line = parse("a.ply b.stl");
    EXPECT_EQ(line.input, "a.ply");
    EXPECT_EQ(line.output, "b.stl");
    EXPECT_EQ(line.report, "");
    EXPECT_FALSE(line.quiet);
    EXPECT_TRUE(line.lengths.empty());
    EXPECT_EQ(line.properties.at("selected"), "");
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        EXPECT_EQ(parameter.get(line.parameters), parameter.get({})) << parameter.name;
    }
}

TEST(CommandLine, EveryOptionIsTaken) {
    std::vector<std::string> words = words_of(
        "a.PLY b.Stl --detail-size 0.75% --order 4 --depth 7 --step-size 2.5e-4 --iterations=3 "
        "--flow conformalized --boundary free --preserve Volume --method paper --tolerance 1e-10 "
        "--threads 2 --report r.json --quiet --selected");
    words.emplace_back("my quality");
    const auto line = parse(words);
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
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
            const std::string& name = parameter.choices[i].name;
            const auto line = parse({"a.ply", "b.ply", option_of(parameter.name), name});
            EXPECT_EQ(parameter.get(line.parameters), ParameterValue(static_cast<int>(i))) << name;
        }
    }
}

TEST(CommandLine, ALengthIsInUnitsOfTheMeshOrInPerCent) {
    for (const auto& [text, value, in_per_cent] : {std::tuple{"1.5", 1.5, false},
                                                   {"2e-3", 2e-3, false},
                                                   {"0", 0., false},
                                                   {"0.5%", 0.5, true},
                                                   {"1e2%", 100., true},
                                                   {"0%", 0., true}}) {
        const auto line = parse({"a.ply", "b.ply", "--detail-size", text});
        EXPECT_EQ(line.lengths.at("detail_size").value, value) << text;
        EXPECT_EQ(line.lengths.at("detail_size").in_per_cent, in_per_cent) << text;
    }
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
    EXPECT_THAT(complaint("a.obj b.ply --selected q"),
                HasSubstr("--selected needs a PLY file as INPUT"));
    EXPECT_EQ(complaint("a.Ply b.stl --selected q"), "none");
    EXPECT_THAT(complaint({"a.ply", "b.stl", "--selected", ""}), HasSubstr("--selected"));
}

TEST(CommandLine, InvalidArgumentsAreNamed) {
    for (const auto& [arguments, named] :
         {std::pair{"a.ply", "OUTPUT is required"},
          {"a.ply b.ply --iterations abc", "--iterations = abc"},
          {"a.ply b.ply --iterations 2.5", "--iterations = 2.5"},
          {"a.ply b.ply --depth 99999999999", "--depth"},
          {"a.ply b.ply --rescale volume", "--rescale"},
          {"a.ply b.ply --order 1.5", "--order = 1.5"},
          {"a.ply b.ply --speed 2", "--speed"},
          {"a.ply b.ply c.ply d.ply", "not expected: c.ply d.ply."},
          {"a.ply b.ply --bad", "tracked_mcf --help"},
          {"a.ply b.ply --report ./b.ply", "--report would overwrite the mesh b.ply"},
          {"a.ply b.ply --report a.ply", "--report would overwrite the mesh a.ply"},
          {"a.ply b.ply --report c.ply", "--report would write JSON to c.ply"}}) {
        EXPECT_THAT(complaint(arguments), HasSubstr(named)) << arguments;
    }
}

TEST(CommandLine, TheExtensionTellsTheFormat) {
    EXPECT_EQ(complaint("a.ply b.xyz"),
              "b.xyz: the extension tells the format; give .ply, .obj, .off or .stl.");
    EXPECT_EQ(complaint("scan b.ply"),
              "scan: the extension tells the format; give .ply, .obj, .off or .stl.");
    EXPECT_EQ(complaint("a.ply b.obj"),
              "b.obj: only PLY and STL can be written from another format; give OUTPUT the "
              "extension of INPUT, .ply or .stl.");
}

TEST(CommandLine, HelpNamesEveryOptionAndExplainsTheSharedParameters) {
    const std::string help = parse("--help").answer;
    for (const char* word :
         {"INPUT", "OUTPUT", "--detail-size X|X%", "--selected", "PROPERTY", "--report", "--quiet",
          "--version", "--help", "Examples:", "Exit codes:", "PLY, OBJ, OFF and STL"}) {
        EXPECT_THAT(help, HasSubstr(word));
    }
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        std::string option = option_of(parameter.name);
        for (const NamedChoice& choice : parameter.choices)
            option += (&choice == &parameter.choices.front() ? ' ' : '|') + choice.name;
        EXPECT_THAT(help, HasSubstr(option));
        EXPECT_THAT(unwrapped(help), HasSubstr(parameter.help)) << parameter.name;
    }
    // The labels of fields, such as "Detail size (0: auto)", are for dialogs.
    EXPECT_THAT(unwrapped(help), Not(HasSubstr("(0: ")));
}

TEST(CommandLine, HelpFitsIntoEightyColumns) {
    for (const std::string& help : {parse_command_line<FlowParameters>({"--help"}).answer,
                                    parse_command_line<NoiseParameters>({"--help"}).answer,
                                    parse_command_line<FairParameters>({"--help"}).answer}) {
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    }
}

}  // namespace
}  // namespace tracked_mcf
