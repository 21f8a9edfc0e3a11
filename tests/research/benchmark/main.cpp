// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one measurement and prints its results as CSV.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "tests/research/benchmark/subcommands.h"

int main(int argc, char** argv) {
    using namespace tracked_mcf::benchmark;
    CLI::App app("Measures the flow and its peers. run_benchmark.py calls this program.");
    app.require_subcommand(1);
    add_flow(app);
    add_incomplete_cholesky(app);
    add_solvers(app);
    add_cgal(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::cerr << "tracked_mcf_benchmark: " << error.what() << '\n';
        return 1;
    }
}
