// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/tracked_options.h"

#include <CLI/CLI.hpp>

#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::benchmark {

FlowParameters TrackedOptions::parameters() const {
    FlowParameters parameters = experiments::parse_configuration(configuration);
    parameters.step_size = step_size;
    parameters.depth = depth;
    parameters.iterations = steps;
    parameters.threads = threads;
    return parameters;
}

void add_options(CLI::App& command, TrackedOptions& options) {
    command.add_option("mesh", options.mesh, "see tests/research/benchmark/meshes.h")->required();
    command.add_option("--solver", options.configuration,
                       "see tests/research/experiments/configuration.h");
    command.add_option("--step-size", options.step_size);
    command.add_option("--depth", options.depth, "0: automatic");
    command.add_option("--steps", options.steps)->check(CLI::PositiveNumber);
    command.add_option("--threads", options.threads)->check(CLI::PositiveNumber);
}

}  // namespace tracked_mcf::benchmark
