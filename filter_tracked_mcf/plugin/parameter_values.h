// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// A parameter's value: an int for an Integer or for the index of a Choice's label, a double for a
/// Real, a bool for a Boolean or a SelectionSwitch.
using ParameterValue = std::variant<int, double, bool>;

/// The values that a host gives for the parameters of the table, by name.
using ParameterValues = std::map<std::string, ParameterValue>;

/// Returns the core's parameters for these values. Throws InvalidParameter if a value is missing or
/// has another type, or if a Choice's index has no label. The core checks all other ranges.
FlowParameters flow_parameters(const ParameterValues& values);

/// Returns whether only selected faces flow. Throws InvalidParameter if the value is missing.
bool selected_only(const ParameterValues& values);

/// Returns the decimal number that a user typed where a host passes `value`. Many hosts round real
/// parameters to floats. A `value` that is a float becomes the double nearest to the float's
/// shortest decimal notation, 1e-5 for 9.99999974737875e-06, so that the plugin flows exactly as
/// the command-line tool does. Any other double is returned unchanged.
double as_typed(double value);

}  // namespace tracked_mcf
