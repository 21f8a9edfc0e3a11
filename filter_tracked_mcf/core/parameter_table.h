// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"

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
    std::string label;  ///< in a dialog and in PyMeshLab, such as "Locked cells (paper)"
    std::string name;   ///< on the command line, in Python and reports, such as "locked-cells"
};

/// The member of FlowParameters that a parameter sets.
struct ParameterMember {
    enum class Type {
        Switch,    ///< bool, off by default; in the program a flag
        Selected,  ///< bool; no member, because hosts select the faces that flow
        Strength,  ///< bool; no member, because hosts give each vertex its strength
        Integer,
        Real,
        Length,  ///< double, in units of the mesh; hosts also take per cent of the box's diagonal
        Choice   ///< int, counted from 0
    };

    Type type;
    ParameterValue (*get)(const FlowParameters&);
    void (*set)(FlowParameters&, const ParameterValue&);  ///< takes the type that `get` returns
    Range range;
    std::vector<NamedChoice> choices;  ///< in the order of the enumerators
};

/// One parameter of a flow, and how hosts offer it.
///
/// To add a parameter, add a member to FlowParameters and a row to the table. Dialog, scripts,
/// PyMeshLab, the Python package, the program's options, help and report, and validate() follow the
/// row.
struct Parameter : ParameterMember {
    std::string name;  ///< in scripts and reports; with dashes, the program's option; never changes
    std::string label;  ///< in a dialog; empty if MeshLab does not offer the parameter
    std::string help;   ///< its meaning, its unit, and advice
};

/// Returns the parameters in the order of a dialog, then those of the program alone.
const std::vector<Parameter>& parameter_table();

}  // namespace tracked_mcf
