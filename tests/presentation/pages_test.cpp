// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the pages of the project with the table of parameters.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"

namespace tracked_mcf {

namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;  // a name and a default, each

std::string page(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(TRACKED_MCF_SOURCE_DIR "/" + file).rdbuf();
    return text.str();
}

/// Returns the two groups of each match.
Rows matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Rows rows;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
        rows.emplace_back((*i)[1], (*i)[2]);
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

/// Expects that the table after a heading of a page has the names and defaults of the parameters
/// that dialogs have, or of those that the program alone has.
template <class Parameters>
void expect_table(const std::string& file, const std::string& heading, const std::string& pattern,
                  bool in_dialogs) {
    Rows expected;
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (parameter.label.empty() == in_dialogs) continue;
        std::string name = parameter.name;
        // The program's options have dashes.
        if (!in_dialogs) std::replace(name.begin(), name.end(), '_', '-');
        expected.emplace_back(name, default_in_words(parameter));
    }
    for (const Input& input : input_table<Parameters>()) {
        const char* const initial = input.of_faces ? "on if faces are selected" : "off";
        if (in_dialogs && !input.label.empty()) expected.emplace_back(input.name, initial);
    }
    const std::string text = page(file);
    const std::size_t begin = text.find(heading);
    const std::string section = text.substr(begin, text.find("\n## ", begin + 1) - begin);
    EXPECT_EQ(matches(section, pattern), expected) << file;
}

TEST(Pages, TablesHaveTheNamesAndDefaultsOfAllParameters) {
    const char* const in_dialogs = "\n\\| `([a-z_]+)` \\| ([^|]*) \\|";
    const char* const file = "filter_tracked_mcf/presentation/README.md";
    expect_table<FlowParameters>(file, "\n## Mean Curvature Flow", in_dialogs, true);
    expect_table<NoiseParameters>(file, "\n## Remove Noise", in_dialogs, true);
    expect_table<FairParameters>(file, "\n## Fair Selected Faces", in_dialogs, true);
    expect_table<FlowParameters>("filter_tracked_mcf/hosts/cli/README.md", "\nFurther options",
                                 "\n\\| `--([a-z-]+) [^`]*` \\| ([^| ]+) \\|", false);
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
        expected.emplace_back(parameter.name, std::visit(in_xml, parameter.initial));
    }
    for (const Input& input : input_table<Parameters>()) {
        if (!input.label.empty()) expected.emplace_back(input.name, "false");
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
