// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one experiment and prints its results as CSV.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "tests/research/experiments/experiments.h"

int main(int argc, char** argv) {
    using namespace tracked_mcf::experiments;
    CLI::App app("Measures the flow. The scripts in tests/research/experiments call this.");
    app.require_subcommand(1);
    add_cells(app);
    add_sphere(app);
    add_stages(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::cerr << "tracked_mcf_experiments: " << error.what() << '\n';
        return 1;
    }
}
