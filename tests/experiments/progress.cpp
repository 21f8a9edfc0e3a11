// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::experiments {

namespace {

struct ProgressOptions : Options {
    std::vector<int> threads = {1, 2};
    int repetitions = 5;
};

/// The longest times without a call of the callback, in seconds: during the set-up, from the first
/// step on, and from the last call until evolve() returns.
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

/// Returns the processor time of a flow, over all threads, in seconds.
double cost_of(TriangleMesh mesh, const FlowParameters& parameters, const Progress& progress) {
    const double start = cpu_seconds();
    evolve(mesh, parameters, progress);
    return cpu_seconds() - start;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure(const TriangleMesh& mesh, const ProgressOptions& options, int threads) {
    FlowParameters parameters =
        options.parameters(options.depths.front(), options.configurations.front());
    parameters.iterations = options.last_step();
    parameters.threads = threads;
    std::vector<double> setup, steps, end, calls, with, without;
    for (int repetition = 0; repetition < options.repetitions; ++repetition) {
        const Gaps gaps = gaps_of(mesh, parameters);
        setup.push_back(1e3 * gaps.setup);
        steps.push_back(1e3 * gaps.steps);
        end.push_back(1e3 * gaps.end);
        calls.push_back(gaps.calls);
        // Alternates, so that other load on the machine affects both alike.
        with.push_back(cost_of(mesh, parameters, [](double, std::string_view) { return true; }));
        without.push_back(cost_of(mesh, parameters, {}));
    }
    print_row(threads, median(calls), median(setup), median(steps), median(end), median(with),
              median(without));
}

void run(const ProgressOptions& options) {
    print_row("threads", "calls", "setup_ms", "steps_ms", "end_ms", "cpu_seconds",
              "cpu_seconds_without");
    const TriangleMesh mesh = named_mesh(options.mesh);
    for (const int threads : options.threads) measure(mesh, options, threads);
}

}  // namespace

void add_progress(CLI::App& app) {
    const auto [command, options] =
        add_experiment(app, "progress",
                       "Prints the longest times between calls of the progress "
                       "callback, and the cost of the calls.",
                       run, with_defaults<ProgressOptions>({3}, 1e-5));
    command->add_option("--threads", options->threads);
    command->add_option("--repetitions", options->repetitions)->check(CLI::PositiveNumber);
}

}  // namespace tracked_mcf::experiments
