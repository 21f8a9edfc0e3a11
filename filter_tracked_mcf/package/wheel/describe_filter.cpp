// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the docstring of the filter's Python method, from the table of parameters.
#include <iomanip>
#include <iostream>
#include <regex>
#include <sstream>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/parameters/filter_names.h"

namespace {

using tracked_mcf::NamedChoice;
using tracked_mcf::Parameter;

/// Returns a parameter's Python type and default, such as "int = 3". A default that depends on the
/// mesh is left out.
std::string python_type(const Parameter& parameter) {
    const tracked_mcf::ParameterValue value = parameter.get({});
    std::ostringstream text;
    text << std::showpoint << std::setprecision(2);
    switch (parameter.type) {
        case Parameter::Type::Switch:
        case Parameter::Type::Strength:
            return std::get<bool>(value) ? "bool = True" : "bool = False";
        case Parameter::Type::Selected:
            return "bool, by default True if faces are selected";
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

int main() {
    const std::string html = std::regex_replace(tracked_mcf::kFilterHelp, std::regex("<br>"), "\n");
    std::cout << std::regex_replace(html, std::regex("<[^>]*>"), "") << "\n\nParameters:\n";
    for (const Parameter& parameter : tracked_mcf::parameter_table()) {
        if (parameter.label.empty()) continue;
        std::cout << "    " << parameter.name << ": " << python_type(parameter) << "\n        "
                  << parameter.label << ": " << parameter.help << '\n';
    }
    std::cout << "\nReturns a dictionary of numbers, such as largest_displacement, and the list "
                 "warnings.\n";
}
