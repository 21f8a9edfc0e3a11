#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/automatic_depth.h"
#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/kernels/instruction_set.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    int frequency = 256;
    int depth = 0;
    int repetitions = 7;
};

/// Processor time of one assembly, s.
double assembly_seconds(const TrackedElements& elements, const Coefficients& displacement,
                        FlowKind flow, ElementSystems& systems) {
    const std::clock_t begin = std::clock();
    assemble_elements(elements, displacement, {1, 30, flow}, systems);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void run(const Options& options) {
    const ThreadCountScope one_thread(1);
    const TriangleMesh mesh = shapes::geodesic_sphere(options.frequency);
    const int depth = options.depth == 0 ? automatic_depth(mesh) : options.depth;
    const TrackedElements elements =
        build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints);
    const Coefficients displacement = 0.01 * identity_coefficients(elements);
    ElementSystems systems;
    print_row("instructions", "flow", "elements", "samples", "nanoseconds_per_sample");
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        std::vector<double> seconds(static_cast<std::size_t>(options.repetitions));
        for (double& time : seconds) {
            time = assembly_seconds(elements, displacement, flow, systems);
        }
        std::sort(seconds.begin(), seconds.end());
        const double median = seconds[seconds.size() / 2];
        print_row(name_of(choose_instruction_set()),
                  flow == FlowKind::MeanCurvature ? "mean curvature" : "conformalized",
                  elements.finest().element_count(), elements.samples.size(),
                  1e9 * median / static_cast<double>(elements.samples.size()));
    }
}

}  // namespace

void add_kernel(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "kernel",
        "Processor time of the assembly of a sphere's element matrices by one thread, median. "
        "TRACKED_MCF_INSTRUCTIONS chooses the instructions.");
    command->add_option("--frequency", options->frequency, "of the geodesic sphere");
    command->add_option("--depth", options->depth, "0 chooses automatically");
    command->add_option("--repetitions", options->repetitions)->check(CLI::PositiveNumber);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
