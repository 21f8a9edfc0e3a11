#pragma once

#include <map>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// The value of an Integer, a Real, a Boolean or a SelectionSwitch, or the index of a Choice's
/// label.
using ParameterValue = std::variant<int, double, bool>;

/// What a host gives for the parameters of the table, by name.
using ParameterValues = std::map<std::string, ParameterValue>;

/// What the core is to do. Throws InvalidParameter where a value is absent or of another type, or
/// where a Choice's index has no label: hosts pass on what a script holds. The other ranges are the
/// core's to check.
FlowParameters flow_parameters(const ParameterValues& values);

/// Whether only selected faces are to flow. Throws InvalidParameter where that is not said.
bool selected_only(const ParameterValues& values);

/// The number that was typed where a host passes `value`. Many keep real parameters as floats, but
/// what is typed is a decimal: a value that is a float becomes the double that the float's shortest
/// decimal notation denotes, 1e-5 for 9.99999974737875e-06, so that the plugin flows exactly as the
/// command-line tool. Any other double was passed as it is.
double as_typed(double value);

}  // namespace tracked_mcf
