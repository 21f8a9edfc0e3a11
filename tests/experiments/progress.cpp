#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/stopwatch.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    std::string configuration = "converged";
    std::vector<int> threads = {1, 2};
    int depth = 0;
    int iterations = 3;
    int repetitions = 5;
};

/// The largest times without a call of the callback, in seconds: in the set-up, in the steps and
/// what follows them, and from the last call until evolve() returns.
struct Gaps {
    double setup = 0, steps = 0, end = 0;
    int calls = 0;
};

Gaps gaps_of(TriangleMesh mesh, const FlowParameters& parameters) {
    Gaps gaps;
    bool stepping = false;
    Stopwatch since_call;
    evolve(mesh, parameters, [&](double, std::string_view phase) {
        double& largest = stepping ? gaps.steps : gaps.setup;
        largest = std::max(largest, since_call.seconds());
        stepping = stepping || phase.substr(0, 4) == "Step";
        ++gaps.calls;
        since_call = Stopwatch();
        return true;
    });
    gaps.end = since_call.seconds();
    return gaps;
}

/// Processor time of all threads, in seconds, that a flow takes.
double cost_of(TriangleMesh mesh, const FlowParameters& parameters, const Progress& progress) {
    const std::clock_t start = std::clock();
    evolve(mesh, parameters, progress);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure(const TriangleMesh& mesh, const Options& options, int threads) {
    FlowParameters parameters = parse_configuration(options.configuration);
    parameters.depth = options.depth;
    parameters.iterations = options.iterations;
    parameters.threads = threads;
    std::vector<double> setup, steps, end, calls, with, without;
    for (int repetition = 0; repetition < options.repetitions; ++repetition) {
        const Gaps gaps = gaps_of(mesh, parameters);
        setup.push_back(1e3 * gaps.setup);
        steps.push_back(1e3 * gaps.steps);
        end.push_back(1e3 * gaps.end);
        calls.push_back(gaps.calls);
        // In turn, so that what else the machine does falls on both alike.
        with.push_back(cost_of(mesh, parameters, [](double, std::string_view) { return true; }));
        without.push_back(cost_of(mesh, parameters, {}));
    }
    print_row(threads, median(calls), median(setup), median(steps), median(end), median(with),
              median(without));
}

void run(const Options& options) {
    print_row("threads", "calls", "setup_ms", "steps_ms", "end_ms", "cpu_seconds",
              "cpu_seconds_without");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int threads : options.threads) measure(mesh, options, threads);
}

}  // namespace

void add_progress(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "progress", "The largest times between calls of the callback, and what the calls cost.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--configuration", options->configuration);
    command->add_option("--threads", options->threads);
    command->add_option("--depth", options->depth);
    command->add_option("--iterations", options->iterations);
    command->add_option("--repetitions", options->repetitions)->check(CLI::PositiveNumber);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
