// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the pages of the project with the table of parameters.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "filter_tracked_mcf/core/parameter_table.h"

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
    if (parameter.type == Parameter::Type::Length) return "2.5 mean edge lengths";
    if (parameter.type == Parameter::Type::Selected) return "on if faces are selected";
    const bool is_switch =
        parameter.type == Parameter::Type::Switch || parameter.type == Parameter::Type::Strength;
    if (is_switch) return std::get<bool>(value) ? "on" : "off";
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
void expect_table(const std::string& file, const std::string& heading, const std::string& pattern,
                  bool in_dialogs) {
    Rows expected;
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        if (parameter.label.empty() == in_dialogs) continue;
        std::string name = parameter.name;
        // The program's options have dashes.
        if (!in_dialogs) std::replace(name.begin(), name.end(), '_', '-');
        expected.emplace_back(name, default_in_words(parameter));
    }
    const std::string text = page(file);
    EXPECT_EQ(matches(text.substr(text.find(heading)), pattern), expected);
}

TEST(Pages, TablesHaveTheNamesAndDefaultsOfAllParameters) {
    expect_table("README.md", "\n## Parameters", "\n\\| `([a-z_]+)` \\| ([^|]*) \\|", true);
    expect_table("filter_tracked_mcf/tool/README.md", "\nFurther options",
                 "\n\\| `--([a-z-]+) [^`]*` \\| ([^| ]+) \\|", false);
}

TEST(Pages, TheFilterScriptSetsAllParametersToTheirDefaults) {
    Rows expected;
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        if (parameter.label.empty()) continue;
        const auto in_xml = [](auto value) -> std::string {
            std::ostringstream text;
            text << std::boolalpha << value;
            return text.str();
        };
        expected.emplace_back(parameter.name, std::visit(in_xml, parameter.initial));
    }
    const std::string text = page("filter_tracked_mcf/plugin/README.md");
    EXPECT_EQ(matches(text, "<Param type=\"\\w+\" name=\"(\\w+)\" value=\"([^\"]*)\""), expected);
}

}  // namespace

}  // namespace tracked_mcf
