// SPDX-License-Identifier: GPL-3.0-or-later
// Smooths random bad meshes with random parameters and checks what must hold for all of them.

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "tests/zoo/properties.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf::zoo {
namespace {

struct Options {
    std::uint64_t seed = 1;
    std::int64_t cases = 1000;
    double seconds = 0;
    std::vector<std::int64_t> chosen;  ///< run only these cases
    double tolerance = 0;              ///< solve to this tolerance; 0 leaves the case's solver
    bool remove_noise = false, fair = false;  ///< instead of making flows
    std::string file;
};

/// What happened to the cases of one kind of mesh.
struct Counts {
    int cases = 0;
    int refused = 0;
    std::array<int, kPropertyNames.size()> failed{};
};

class Zoo {
public:
    explicit Zoo(const Options& options) : options_(options) {}

    /// Runs all cases. Returns whether all properties held.
    bool run() {
        for (const std::int64_t number : options_.chosen) run_case(number, true);
        if (options_.chosen.empty()) run_many();
        print_table();
        return failures_ == 0;
    }

private:
    void run_many();
    Case make_case(std::int64_t number) const;
    void run_case(std::int64_t number, bool is_chosen);
    void print_table() const;

    const Options& options_;
    std::map<std::string, Counts> counts_;
    int failures_ = 0;
};

void Zoo::run_many() {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto runs_on = [&](std::int64_t done) {
        if (options_.seconds <= 0) return done < options_.cases;
        return std::chrono::duration<double>(Clock::now() - start).count() < options_.seconds;
    };
    for (std::int64_t done = 0; runs_on(done); ++done) run_case(done, false);
}

Case Zoo::make_case(std::int64_t number) const {
    if (options_.remove_noise) return noise_case_of(options_.seed, number);
    if (options_.fair) return fair_case_of(options_.seed, number);
    Case made = case_of(options_.seed, number);
    if (options_.tolerance > 0) {
        made.parameters.method = Method::Converged;
        made.parameters.tolerance = options_.tolerance;
    }
    return made;
}

void Zoo::run_case(std::int64_t number, bool is_chosen) {
    const Case made = make_case(number);
    if (!options_.file.empty()) write_ply(made, options_.file);
    // The additional runs of every fourth case take as long as all other runs.
    Random random(options_.seed, ~static_cast<std::uint64_t>(number));
    const bool all_properties = is_chosen || number % 4 == 0;
    const Outcome outcome = check(made, all_properties, random);
    Counts& counts = counts_[made.kind];
    ++counts.cases;
    if (!outcome.refusal.empty()) ++counts.refused;
    for (const Failure& failure : outcome.failures) {
        const auto property = static_cast<std::size_t>(failure.property);
        ++counts.failed[property];
        ++failures_;
        std::cout << "--seed " << options_.seed << " --case " << number << ": " << made.kind << ": "
                  << kPropertyNames[property] << ": " << failure.what << "; " << options_of(made)
                  << '\n'
                  << std::flush;
    }
    if (is_chosen && !outcome.refusal.empty()) std::cout << "refused: " << outcome.refusal << '\n';
    if (is_chosen) std::cout << options_of(made) << '\n';
}

void Zoo::print_table() const {
    constexpr int name_columns = 22, columns = 12;
    std::cout << std::left << std::setw(name_columns) << "kind" << std::right << std::setw(columns)
              << "cases" << std::setw(columns) << "refused";
    for (const char* name : kPropertyNames) std::cout << std::setw(columns) << name;
    std::cout << '\n';
    Counts all;
    const auto print = [&](const std::string& name, const Counts& counts) {
        std::cout << std::left << std::setw(name_columns) << name << std::right
                  << std::setw(columns) << counts.cases << std::setw(columns) << counts.refused;
        for (const int failed : counts.failed) std::cout << std::setw(columns) << failed;
        std::cout << '\n';
    };
    for (const auto& [kind, counts] : counts_) {
        print(kind, counts);
        all.cases += counts.cases;
        all.refused += counts.refused;
        for (std::size_t i = 0; i < all.failed.size(); ++i) all.failed[i] += counts.failed[i];
    }
    print("all", all);
}

}  // namespace
}  // namespace tracked_mcf::zoo

int main(int argc, char** argv) {
    using namespace tracked_mcf::zoo;
    CLI::App app("Smooths random bad meshes and checks what must hold for all of them.");
    Options options;
    app.add_option("--seed", options.seed, "Seed of the cases")->capture_default_str();
    app.add_option("--cases", options.cases, "Number of cases")->capture_default_str();
    app.add_option("--seconds", options.seconds, "Run for this time instead");
    app.add_option("--case", options.chosen, "Run only these cases, and check all properties");
    app.add_option(
        "--tolerance", options.tolerance,
        "Solve every case to this tolerance, which tells the solver's error from others");
    app.add_flag("--remove-noise", options.remove_noise, "Remove noise instead of making flows");
    app.add_flag("--fair", options.fair, "Fair patches instead")->excludes("--remove-noise");
    app.add_option("--write", options.file, "With --case: write its mesh to this PLY file")
        ->needs("--case");
    try {
        app.parse(argc, argv);
        return Zoo(options).run() ? 0 : 1;
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::cerr << "tracked_mcf_zoo: " << error.what() << '\n';
        return 2;
    }
}
