// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the pages of the project with the table of parameters.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"

namespace tracked_mcf {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string page(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(TRACKED_MCF_SOURCE_DIR "/" + file).rdbuf();
    return text.str();
}

/// Returns the groups of each match.
Rows matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Rows rows;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
        rows.emplace_back(std::next(i->begin()), i->end());
    }
    return rows;
}

std::string default_in_words(const Parameter& parameter) {
    const ParameterValue value = parameter.initial;
    if (&parameter == &parameter_table<FlowParameters>()[0]) return "3 mean edge lengths";
    if (const bool* const is_on = std::get_if<bool>(&value)) return *is_on ? "on" : "off";
    if (parameter.type == Parameter::Type::Choice) {
        const NamedChoice& choice = parameter.choices.at(std::size_t(std::get<int>(value)));
        return parameter.label.empty() ? choice.name : choice.label;
    }
    std::ostringstream text;
    std::visit([&text](auto number) { text << number; }, value);
    return text.str();
}

/// Returns the name of the program's option.
std::string option_of(const Parameter& parameter) {
    std::string name = parameter.name;
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

/// Expects the rows in the table after a heading of a page.
void expect_rows(const Rows& expected, const std::string& file, const std::string& heading,
                 const std::string& pattern) {
    const std::string text = page(file);
    const std::size_t begin = text.find(heading);
    const std::string section = text.substr(begin, text.find("\n## ", begin + 1) - begin);
    EXPECT_EQ(matches(section, pattern), expected) << file;
}

/// Expects that the filter's table has what dialogs, the program and scripts call each parameter,
/// and its default.
template <class Parameters>
void expect_table() {
    Rows expected;
    const auto add = [&expected](const Parameter& row, const std::string& initial) {
        if (!row.label.empty()) expected.push_back({row.label, option_of(row), row.name, initial});
    };
    for (const auto& row : parameter_table<Parameters>()) add(row, default_in_words(row));
    for (const Input& row : input_table<Parameters>()) {
        add(row, row.of_faces ? "on if faces are selected" : "off");
    }
    expect_rows(expected, "filter_tracked_mcf/presentation/README.md",
                std::string("\n## ") + kNames<Parameters>.name,
                "\n\\| ([^|]+) \\| `--([a-z-]+)` \\| `([a-z_]+)` \\| ([^|]*) \\|");
}

TEST(Pages, TablesHaveTheNamesAndDefaultsOfAllParameters) {
    expect_table<FlowParameters>();
    expect_table<NoiseParameters>();
    expect_table<FairParameters>();
}

TEST(Pages, TheProgramsPageHasItsOwnParameters) {
    Rows expected;
    for (const auto& row : parameter_table<FlowParameters>()) {
        if (row.label.empty()) expected.push_back({option_of(row), default_in_words(row)});
    }
    expect_rows(expected, "filter_tracked_mcf/hosts/cli/README.md", "\nFurther options",
                "\n\\| `--([a-z-]+) [^`]*` \\| ([^| ]+) \\|");
}

/// Expects that the plugin's page has a filter script with the defaults of all parameters.
template <class Parameters>
void expect_script() {
    Rows expected;
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (parameter.label.empty()) continue;
        const auto in_xml = [](auto value) -> std::string {
            std::ostringstream text;
            text << std::boolalpha << value;
            return text.str();
        };
        expected.push_back({parameter.name, std::visit(in_xml, parameter.initial)});
    }
    for (const Input& input : input_table<Parameters>()) {
        if (!input.label.empty()) expected.push_back({input.name, "false"});
    }
    const std::string file = "filter_tracked_mcf/hosts/meshlab/README.md";
    const std::string text = page(file);
    const std::size_t begin =
        text.find("<filter name=\"" + std::string(kNames<Parameters>.name) + "\">");
    ASSERT_LT(begin, text.size());
    const std::string script = text.substr(begin, text.find("</filter>", begin) - begin);
    EXPECT_EQ(matches(script, "<Param type=\"\\w+\" name=\"(\\w+)\" value=\"([^\"]*)\""), expected)
        << file;
}

TEST(Pages, TheFilterScriptsSetAllParametersToTheirDefaults) {
    expect_script<FlowParameters>();
    expect_script<NoiseParameters>();
    expect_script<FairParameters>();
}

/// MeshLab 2020.09 shows two lines of help beside a parameter on a screen of 1280 by 900.
template <class Parameters>
void expect_short_help() {
    constexpr std::size_t most = 102;  // letters
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (parameter.label.empty()) continue;
        EXPECT_LE(parameter.help.size(), most) << parameter.name;
    }
    for (const Input& input : input_table<Parameters>()) {
        if (input.label.empty()) continue;
        EXPECT_LE(input.help.size(), most) << input.name;
    }
}

TEST(Help, FitsTwoLinesOfADialog) {
    expect_short_help<FlowParameters>();
    expect_short_help<NoiseParameters>();
    expect_short_help<FairParameters>();
}

}  // namespace

}  // namespace tracked_mcf
