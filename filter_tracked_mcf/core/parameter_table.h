// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A parameter's value. That of a choice is its place among Parameter::choices.
using ParameterValue = std::variant<bool, int, double>;

/// The largest number of a range without an upper bound.
inline constexpr double kFinite = std::numeric_limits<double>::max();

/// The numbers that a parameter may be; neither infinities nor NaN.
struct Range {
    double smallest, largest;
    std::string advice;  ///< ends the message about a refused number
    bool open = false;   ///< whether `smallest` and `largest` are refused, too
};

/// A value of a choice.
struct NamedChoice {
    std::string label;  ///< in a dialog and in PyMeshLab, such as "Mean curvature"
    std::string name;   ///< on the command line, in Python and reports, such as "mean-curvature"
};

/// One parameter, and how hosts offer it.
struct Parameter {
    enum class Type {
        Switch,  ///< bool, off by default; in the program a flag
        Integer,
        Real,
        Length,  ///< double, in units of the mesh; hosts also take per cent of the box's diagonal
        Choice   ///< int, counted from 0
    };

    Type type;
    Range range;
    std::vector<NamedChoice> choices;  ///< in the order of the enumerators
    std::string name;  ///< in scripts and reports; with dashes, the program's option; never changes
    std::string label;       ///< in a dialog; empty if MeshLab does not offer the parameter
    std::string help;        ///< its meaning, its unit, and advice
    ParameterValue initial;  ///< the default
};

/// A parameter with the member of `Parameters` that it sets.
template <class Parameters>
struct ParameterOf : Parameter {
    ParameterValue (*get)(const Parameters&);
    void (*set)(Parameters&, const ParameterValue&);  ///< takes the type that `get` returns
};

/// Returns the parameters of a filter in the order of its dialog, then those of the program alone.
/// `Parameters` is FlowParameters, NoiseParameters or FairParameters.
///
/// To add a parameter, add a member and a row to the table. Dialog, scripts, PyMeshLab, the Python
/// package, the program's options, help and report, and the check of the range follow the row.
template <class Parameters>
const std::vector<ParameterOf<Parameters>>& parameter_table();

template <>
const std::vector<ParameterOf<FlowParameters>>& parameter_table();
template <>
const std::vector<ParameterOf<NoiseParameters>>& parameter_table();
template <>
const std::vector<ParameterOf<FairParameters>>& parameter_table();

/// One of the Inputs, and how hosts offer it: dialogs and scripts as a switch, which takes it from
/// the layer's selection or vertex quality; the program as the name of a property; Python as an
/// array.
struct Input : Parameter {
    Selection Inputs::*of_faces = nullptr;  ///< the member, or null
    std::vector<double> Inputs::*of_vertices = nullptr;
};

/// Returns the inputs of a filter. Hosts offer them after its parameters.
///
/// To add an input, add a member to Inputs, its checks to validate(), and a row to the table.
template <class Parameters>
const std::vector<Input>& input_table();

template <>
const std::vector<Input>& input_table<FlowParameters>();
template <>
const std::vector<Input>& input_table<NoiseParameters>();
template <>
const std::vector<Input>& input_table<FairParameters>();

/// Throws InvalidParameter unless `value` is in the range of the parameter `name`.
void check_range(const std::string& name, double value, const Range& range);

/// Throws InvalidParameter unless all values are in the ranges of their rows.
template <class Parameters>
void check_ranges(const Parameters& parameters) {
    for (const ParameterOf<Parameters>& row : parameter_table<Parameters>()) {
        const auto as_double = [](auto value) { return static_cast<double>(value); };
        check_range(row.name, std::visit(as_double, row.get(parameters)), row.range);
    }
}

}  // namespace tracked_mcf
