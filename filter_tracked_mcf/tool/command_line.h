// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/parameters/length.h"

namespace tracked_mcf {

/// What a call of the program asks for, whatever the filter.
struct CommandLine {
    std::filesystem::path input, output;
    std::filesystem::path report;           ///< empty for none
    std::map<std::string, Length> lengths;  ///< those that were given, by the parameter's name
    std::string selected;  ///< property of INPUT that selects faces; empty for all faces
    std::string strength;  ///< property of INPUT's vertices; empty for none
    int every = 0;         ///< every how many steps the surface is written, too; 0 for never
    bool quiet = false;

    /// What --help or --version print. Unless it is empty, there is nothing else to do.
    std::string answer;
};

/// What a call asks of the filter of these parameters.
template <class Parameters>
struct CommandLineOf : CommandLine {
    Parameters parameters;  ///< but for the lengths
};

/// Parses the arguments of the program, without its name and the filter's. `Parameters` is
/// FlowParameters, NoiseParameters or FairParameters. Throws InvalidParameter for unknown options,
/// values that are no values of their option, and unknown formats. validate() checks the ranges of
/// parameters.
template <class Parameters>
CommandLineOf<Parameters> parse_command_line(std::vector<std::string> arguments);

}  // namespace tracked_mcf
