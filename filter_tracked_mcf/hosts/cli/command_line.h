// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/presentation/length.h"

namespace tracked_mcf {

/// A command of the program, for one filter.
struct Command {
    const char *name, *summary;
};

/// Without a command, the program takes the first one.
inline constexpr std::array<Command, 3> kCommands = {
    {{"smooth", "smooths by mean-curvature flow, also without this word"},
     {"remove-noise", "removes noise of scans and parts, and keeps creases"},
     {"fair", "makes filled holes continue the surface around them"}}};

/// Returns the name that is nearest to a misspelt word, whatever the case; empty if none is near.
std::string nearest_name(std::string word, const std::vector<std::string>& names);

/// What a call of the program asks for, whatever the filter.
struct CommandLine {
    std::filesystem::path input, output;
    std::filesystem::path report;           ///< empty for none
    std::map<std::string, Length> lengths;  ///< those that were given, by the parameter's name
    /// The properties of INPUT for inputs, by the input's name; empty for none.
    std::map<std::string, std::string> properties;
    int every = 0;            ///< every how many steps the surface is written, too; 0 for never
    bool doubles = false;     ///< whether PLY files get doubles, whatever INPUT has
    bool overwrites = false;  ///< whether OUTPUT may have been another mesh
    bool quiet = false;
    bool verbose = false;  ///< whether the numbers of grid and solver are printed, too

    /// What --help or --version print. Unless it is empty, there is nothing else to do.
    std::string answer;
};

/// What a call asks of the filter of these parameters.
template <class Parameters>
struct CommandLineOf : CommandLine {
    Parameters parameters;  ///< but for the lengths
};

/// Returns the option of a parameter, such as "--detail-size" for detail_size.
std::string option_of(const std::string& parameter);

/// Parses the arguments of the program, without its name and the filter's. `Parameters` is
/// FlowParameters, NoiseParameters or FairParameters. Throws InvalidParameter for unknown options,
/// values that are no values of their option, and unknown formats. validate() checks the ranges of
/// parameters.
template <class Parameters>
CommandLineOf<Parameters> parse_command_line(std::vector<std::string> arguments);

}  // namespace tracked_mcf
