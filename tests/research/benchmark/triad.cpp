// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/subcommands.h"

namespace tracked_mcf::benchmark {

namespace {

struct Options {
    int threads = 1;
    std::int64_t megabytes = 128;  ///< of each array
    int repetitions = 15;
};

void triad(std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c) {
    parallel_for_chunks(static_cast<std::int64_t>(a.size()),
                        [&](std::int64_t begin, std::int64_t end) {
                            for (std::int64_t i = begin; i < end; ++i) a[i] = b[i] + 3 * c[i];
                        });
}

void run(const Options& options) {
    const ThreadTeam threads(options.threads);
    const auto count = static_cast<std::size_t>(options.megabytes) * (1U << 20U) / sizeof(double);
    std::vector<double> a(count, 1);
    const std::vector<double> b(count, 2);
    const std::vector<double> c(count, 3);
    triad(a, b, c);
    const double bytes = 3.0 * static_cast<double>(count) * sizeof(double);
    std::vector<double> bandwidths;
    for (int i = 0; i < options.repetitions; ++i) {
        const Stopwatch stopwatch;
        triad(a, b, c);
        bandwidths.push_back(bytes / stopwatch.seconds());
    }
    std::sort(bandwidths.begin(), bandwidths.end());
    print_header();
    print_quantity("best_bytes_per_second", 0, bandwidths.back());
    print_quantity("median_bytes_per_second", 0, bandwidths[bandwidths.size() / 2]);
}

}  // namespace

void add_triad(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("triad",
                                           "Measures the memory bandwidth of a = b + s c over "
                                           "large arrays, counted as three streams.");
    command->add_option("--threads", options->threads)->check(CLI::PositiveNumber);
    command->add_option("--megabytes", options->megabytes)->check(CLI::PositiveNumber);
    command->add_option("--repetitions", options->repetitions)->check(CLI::PositiveNumber);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
