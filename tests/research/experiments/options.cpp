// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/experiments/options.h"

#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::experiments {

FlowParameters Options::parameters(int depth, const std::string& configuration, double unit) const {
    FlowParameters parameters = parse_configuration(configuration);
    parameters.depth = depth;
    parameters.step_size = step_size * unit * unit;
    return parameters;
}

void add_common_options(CLI::App& command, Options& options) {
    command.add_option("mesh", options.mesh, "a file");
    command.add_option("--depths,--depth", options.depths, "0: automatic");
    command.add_option("--steps", options.steps, "numbers of steps after which to measure");
    command.add_option("--step-size", options.step_size);
    command.add_option("--configurations,--configuration", options.configurations,
                       "see configuration.h");
}

}  // namespace tracked_mcf::experiments
