// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/python/pymeshlab_help.h"

#include <iomanip>
#include <regex>
#include <sstream>
#include <variant>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"

namespace tracked_mcf {

namespace {

/// Returns a parameter's Python type and default, such as "int = 3". A default that depends on the
/// mesh is left out.
std::string python_type(const Parameter& parameter) {
    const ParameterValue& value = parameter.initial;
    std::ostringstream text;
    text << std::showpoint << std::setprecision(2);
    switch (parameter.type) {
        case Parameter::Type::Switch:
            return std::get<bool>(value) ? "bool = True" : "bool = False";
        case Parameter::Type::Integer:
            return "int = " + std::to_string(std::get<int>(value));
        case Parameter::Type::Real:
            text << "float = " << std::get<double>(value);
            break;
        case Parameter::Type::Length:
            return "pymeshlab.PercentageValue or pymeshlab.PureValue";
        case Parameter::Type::Choice:
            const NamedChoice& first = parameter.choices[std::get<int>(value)];
            text << "str = '" << first.label << "'";
            for (const NamedChoice& choice : parameter.choices) {
                if (&choice != &first) text << ", or '" << choice.label << "'";
            }
    }
    return text.str();
}

}  // namespace

template <class Parameters>
std::string pymeshlab_help() {
    const std::string html = std::regex_replace(kNames<Parameters>.help, std::regex("<br>"), "\n");
    std::string text = std::regex_replace(html, std::regex("<[^>]*>"), "") + "\n\nParameters:\n";
    const auto add = [&text](const Parameter& parameter, const std::string& type) {
        text += "    " + parameter.name + ": " + type + "\n        " + parameter.label + ": " +
                parameter.help + "\n";
    };
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (!parameter.label.empty()) add(parameter, python_type(parameter));
    }
    for (const Input& input : input_table<Parameters>()) {
        add(input, input.of_faces ? "bool, by default True if faces are selected" : "bool = False");
    }
    return text +
           "\nReturns a dictionary of numbers, such as largest_displacement, and the list "
           "warnings.\n";
}

template std::string pymeshlab_help<FlowParameters>();
template std::string pymeshlab_help<NoiseParameters>();
template std::string pymeshlab_help<FairParameters>();

}  // namespace tracked_mcf
