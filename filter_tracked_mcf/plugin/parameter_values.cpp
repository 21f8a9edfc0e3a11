// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/plugin/parameter_values.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/parameters/parameter_table.h"

namespace tracked_mcf {

namespace {

/// Returns the double nearest to the decimal number of so many digits that is nearest to `value`.
/// Some standard libraries lack std::to_chars for floats.
double rounded(double value, int digits) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    text >> value;
    return value;
}

template <class Type>
Type read(const ParameterValues& values, const std::string& name) {
    const auto found = values.find(name);
    const Type* const value = found == values.end() ? nullptr : std::get_if<Type>(&found->second);
    if (value == nullptr) {
        throw InvalidParameter(name +
                               " is missing or has the wrong type. Save a filter script in "
                               "MeshLab to see how it is written.");
    }
    return *value;
}

void check_choices(const ParameterValues& values) {
    for (const ParameterDescription& parameter : parameter_table()) {
        const auto* const choice = std::get_if<ParameterDescription::Choice>(&parameter.type);
        if (choice == nullptr) continue;
        const int index = read<int>(values, parameter.name);
        const std::vector<std::string>& labels = choice->labels;
        if (index >= 0 && static_cast<std::size_t>(index) < labels.size()) continue;
        std::string message = parameter.name + " is " + std::to_string(index) + "; give";
        for (std::size_t i = 0; i < labels.size(); ++i) {
            message += (i == 0 ? " " : ", ") + std::to_string(i) + " (" + labels[i] + ")";
        }
        throw InvalidParameter(message + ".");
    }
}

}  // namespace

FlowParameters flow_parameters(const ParameterValues& values) {
    check_choices(values);
    FlowParameters parameters;
    parameters.detail_size = read<double>(values, "detail_size");
    parameters.local_detail_size = read<bool>(values, "local_detail_size");
    parameters.depth = read<int>(values, "depth");
    parameters.step_size = read<double>(values, "step_size");
    parameters.absolute = read<bool>(values, "absolute");
    parameters.iterations = read<int>(values, "iterations");
    parameters.order = read<int>(values, "order") + 1;
    parameters.flow = static_cast<FlowKind>(read<int>(values, "flow"));
    parameters.boundary = static_cast<BoundaryCondition>(read<int>(values, "boundary"));
    parameters.preserve = static_cast<Preserve>(read<int>(values, "preserve"));
    parameters.quality = static_cast<Quality>(read<int>(values, "quality"));
    parameters.separate_sheets = read<bool>(values, "separate_sheets");
    parameters.solver = static_cast<Solver>(read<int>(values, "solver"));
    return parameters;
}

bool selected_only(const ParameterValues& values) {
    return read<bool>(values, "selected");
}

double as_typed(double value) {
    if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max()) return value;
    const auto as_float = static_cast<float>(value);
    if (as_float != value) return value;
    // The fewest digits that tell the float from its neighbours. Nine always do.
    double decimal = value;
    for (int digits = 1; digits == 1 || static_cast<float>(decimal) != as_float; ++digits) {
        decimal = rounded(value, digits);
    }
    return decimal;
}

}  // namespace tracked_mcf
