#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// What a call of the program asks for.
struct CommandLine {
    std::filesystem::path input, output;
    std::filesystem::path report;  ///< empty for none
    FlowParameters parameters;
    std::string selected;  ///< property of INPUT that selects what flows; empty for all of it
    bool quiet = false;

    /// What --help or --version print; when there is any, nothing else is to be done.
    std::string answer;
};

/// The command line cannot be obeyed: what() says why and what to do.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws UsageError for unknown options, values that are not what the option wants, and formats
/// that cannot be written. Parameters out of range are left to validate().
CommandLine parse_command_line(int argc, const char* const* argv);

/// How the option --flow spells it.
const char* flow_name(FlowKind flow);

/// How --boundary spells it.
const char* boundary_name(BoundaryCondition boundary);

/// How --rescale spells it.
const char* rescaling_name(Rescaling rescaling);

/// How --solver spells it.
const char* solver_name(Solver solver);

/// What --cubature calls it: its number of samples on a split triangle.
int cubature_name(Cubature cubature);

/// Of the program, such as "1.0.0".
const char* program_version();

}  // namespace tracked_mcf
