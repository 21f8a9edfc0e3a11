#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/stopwatch.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    std::vector<int> depths;
    std::vector<std::string> configurations;
    int repetitions = 7;
};

struct Cost {
    std::int64_t unknowns = 0;
    double seconds = std::numeric_limits<double>::infinity();  ///< the shortest of all
};

void set_up(const TriangleMesh& mesh, int depth, const std::string& configuration, Cost& cost) {
    FlowParameters parameters = parse_configuration(configuration);
    parameters.depth = depth;
    const Stopwatch stopwatch;
    const Flow flow(mesh, parameters);
    cost.seconds = std::min(cost.seconds, stopwatch.seconds());
    cost.unknowns = flow.report().unknowns;
}

void run(const Options& options) {
    print_row("depth", "configuration", "unknowns", "seconds");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int depth : options.depths) {
        std::vector<Cost> costs(options.configurations.size());
        // In turn, so that what else the machine does falls on all alike.
        for (int repetition = 0; repetition < options.repetitions; ++repetition) {
            for (std::size_t i = 0; i < costs.size(); ++i) {
                set_up(mesh, depth, options.configurations[i], costs[i]);
            }
        }
        for (std::size_t i = 0; i < costs.size(); ++i) {
            print_row(depth, options.configurations[i], costs[i].unknowns, costs[i].seconds);
        }
    }
}

}  // namespace

void add_setup(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("setup", "Unknowns, and the shortest of several times of the set-up.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--depths", options->depths)->required();
    command->add_option("--configurations", options->configurations)->required();
    command->add_option("--repetitions", options->repetitions);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
