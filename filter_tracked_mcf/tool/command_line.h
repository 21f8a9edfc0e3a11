// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// The values of an option with their names, in the order of the help.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

inline const Choices<FlowKind> kFlows = {{"mean-curvature", FlowKind::MeanCurvature},
                                         {"conformalized", FlowKind::Conformalized}};

inline const Choices<BoundaryCondition> kBoundaries = {
    {"locked", BoundaryCondition::Locked},
    {"locked-cells", BoundaryCondition::LockedCells},
    {"free", BoundaryCondition::Free}};

inline const Choices<Preserve> kPreserves = {
    {"none", Preserve::None}, {"area", Preserve::Area}, {"volume", Preserve::Volume}};

inline const Choices<Quality> kQualities = {{"none", Quality::None},
                                            {"displacement", Quality::Displacement},
                                            {"mean-curvature", Quality::MeanCurvature}};

inline const Choices<Solver> kSolvers = {{"converged", Solver::Converged},
                                         {"w-cycle", Solver::OneWCycle}};

inline const Choices<Cubature> kCubatures = {
    {"1", Cubature::OnePoint}, {"3", Cubature::ThreePoints}, {"12", Cubature::Degree6}};

/// Returns the name of one of the values.
template <class Value>
const char* name_of(const Choices<Value>& choices, Value value) {
    return std::find_if(choices.begin(), choices.end(),
                        [value](const auto& choice) { return choice.second == value; })
        ->first.c_str();
}

/// A length in units of the mesh, or in per cent of the diagonal of its bounding box.
struct Length {
    double value = 0;
    bool in_per_cent = false;
};

/// What a call of the program asks for.
struct CommandLine {
    std::filesystem::path input, output;
    std::filesystem::path report;  ///< empty for none
    FlowParameters parameters;     ///< but for the detail size
    Length detail_size;
    std::string selected;  ///< property of INPUT that selects faces; empty for all faces
    bool quiet = false;

    /// What --help or --version print. Unless it is empty, there is nothing else to do.
    std::string answer;
};

/// Parses the arguments of the program, without its name. Throws InvalidParameter for unknown
/// options, values that are no values of their option, and unknown formats. validate() checks the
/// ranges of parameters.
CommandLine parse_command_line(std::vector<std::string> arguments);

}  // namespace tracked_mcf
