// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace CLI {  // NOLINT(readability-identifier-naming): it is not ours
class App;
}

namespace tracked_mcf::benchmark {

/// The options of the subcommands that run our flow.
struct TrackedOptions {
    std::string mesh;
    std::string configuration = "converged";
    double step_size = 5e-4;
    int depth = 0;
    int steps = 4;
    int threads = 1;

    /// Returns the parameters for a mesh in the unit cube, with δ in its squared units.
    FlowParameters parameters() const;
};

void add_options(CLI::App& command, TrackedOptions& options);

}  // namespace tracked_mcf::benchmark
