// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf::experiments {

/// The options that experiments have in common, with their defaults.
struct Options {
    std::string mesh;
    std::vector<int> depths = {0};
    std::vector<int> steps = {1};
    double step_size = 1e-5;
    std::vector<std::string> configurations = {"converged"};

    int last_step() const { return *std::max_element(steps.begin(), steps.end()); }
    bool measures_after(int step) const {
        return std::find(steps.begin(), steps.end(), step) != steps.end();
    }

    /// Returns the parameters of a configuration at a depth, for a mesh
    /// of which the longest side is `unit`: as in the paper, a step size is for longest side 1.
    FlowParameters parameters(int depth, const std::string& configuration, double unit = 1) const;

    /// Calls measure(depth, configuration) for every combination.
    template <class Measure>
    void for_each_case(const Measure& measure) const {
        for (const int depth : depths) {
            for (const std::string& configuration : configurations) measure(depth, configuration);
        }
    }
};

void add_common_options(CLI::App& command, Options& options);

/// Adds the subcommand `name`, which calls `run`. Returns the subcommand and its options, so that
/// an experiment can add its own.
template <class OwnOptions>
auto add_experiment(CLI::App& app, const char* name, const char* description,
                    void (*run)(const OwnOptions&), const OwnOptions& defaults) {
    struct Added {
        CLI::App* command;
        OwnOptions* options;
    };
    const auto options = std::make_shared<OwnOptions>(defaults);
    CLI::App* command = app.add_subcommand(name, description);
    add_common_options(*command, *options);
    command->callback([options, run] { run(*options); });
    return Added{command, options.get()};
}

/// Returns options with these defaults.
template <class OwnOptions = Options>
OwnOptions with_defaults(const std::vector<int>& steps, double step_size) {
    OwnOptions options;
    options.steps = steps;
    options.step_size = step_size;
    return options;
}

}  // namespace tracked_mcf::experiments
