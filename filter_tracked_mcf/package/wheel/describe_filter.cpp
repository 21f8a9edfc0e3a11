// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the docstring of the filter's Python method, from the table of parameters.
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <regex>
#include <sstream>
#include <string>
#include <variant>

#include "filter_tracked_mcf/parameters/parameter_table.h"

namespace {

using Description = tracked_mcf::ParameterDescription;

/// Returns a parameter's Python type and default, such as "int = 3". A default that depends on the
/// mesh is left out.
struct PythonType {
    std::string operator()(const Description::Integer& type) const {
        return "int = " + std::to_string(type.default_value);
    }
    std::string operator()(const Description::Real& type) const {
        std::ostringstream text;
        text << "float = " << std::showpoint << std::setprecision(2) << type.default_value;
        return text.str();
    }
    std::string operator()(const Description::Length&) const {
        return "pymeshlab.PercentageValue or pymeshlab.PureValue";
    }
    std::string operator()(const Description::Boolean& type) const {
        return type.default_value ? "bool = True" : "bool = False";
    }
    std::string operator()(const Description::SelectionSwitch&) const {
        return "bool, by default True if faces are selected";
    }
    std::string operator()(const Description::Choice& type) const {
        const auto index = static_cast<std::size_t>(type.default_value);
        std::string text = "str = '" + type.labels[index] + "'";
        for (std::size_t i = 0; i < type.labels.size(); ++i) {
            if (i != index) text += ", or '" + type.labels[i] + "'";
        }
        return text;
    }
};

}  // namespace

int main() {
    const std::string html = std::regex_replace(tracked_mcf::kFilterHelp, std::regex("<br>"), "\n");
    std::cout << std::regex_replace(html, std::regex("<[^>]*>"), "") << "\n\nParameters:\n";
    for (const Description& parameter : tracked_mcf::parameter_table()) {
        std::cout << "    " << parameter.name << ": " << std::visit(PythonType{}, parameter.type)
                  << "\n        " << parameter.label << ": " << parameter.tooltip << '\n';
    }
    std::cout << "\nReturns a dictionary of numbers, such as largest_displacement.\n";
}
