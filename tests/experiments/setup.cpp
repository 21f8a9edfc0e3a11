// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/support/plans.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::experiments {

namespace {

struct SetupOptions : Options {
    int repetitions = 7;
};

struct Cost {
    std::int64_t unknowns = 0;
    double seconds = std::numeric_limits<double>::infinity();  ///< the least of all
};

void set_up(const TriangleMesh& mesh, const FlowParameters& parameters, Cost& cost) {
    const double start = cpu_seconds();
    const Flow flow(plan_of(mesh, parameters));
    cost.seconds = std::min(cost.seconds, cpu_seconds() - start);
    cost.unknowns = flow.report().unknowns;
}

void run(const SetupOptions& options) {
    print_row("depth", "configuration", "unknowns", "seconds");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int depth : options.depths) {
        std::vector<Cost> costs(options.configurations.size());
        // Alternates, so that other load on the machine affects all configurations alike.
        for (int repetition = 0; repetition < options.repetitions; ++repetition) {
            for (std::size_t i = 0; i < costs.size(); ++i) {
                set_up(mesh, options.parameters(depth, options.configurations[i]), costs[i]);
            }
        }
        for (std::size_t i = 0; i < costs.size(); ++i) {
            print_row(depth, options.configurations[i], costs[i].unknowns, costs[i].seconds);
        }
    }
}

}  // namespace

void add_setup(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "setup", "Prints the unknowns and the least processor time of several set-ups.", run,
        SetupOptions());
    command->add_option("--repetitions", options->repetitions);
}

}  // namespace tracked_mcf::experiments
