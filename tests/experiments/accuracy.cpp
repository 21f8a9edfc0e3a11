#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/stopwatch.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/reference.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    std::vector<int> depths;
    std::vector<int> steps;  ///< numbers of steps after which to measure
    std::vector<std::string> configurations;
    double step_size = 1e-5;
};

void measure(const TriangleMesh& mesh, const std::map<int, Reference>& references,
             const Options& options, int depth, const std::string& configuration) {
    FlowParameters parameters = parse_configuration(configuration);
    parameters.depth = depth;
    parameters.step_size = options.step_size;
    parameters.boundary = BoundaryCondition::Free;
    const double unit = diagonal(mesh);
    const Stopwatch stopwatch;
    Flow flow(mesh, parameters);
    int iterations = 0;
    for (int step = 1; step <= references.rbegin()->first; ++step) {
        flow.step();
        iterations += flow.report().steps.back().solver_iterations;
        const auto reference = references.find(step);
        if (reference == references.end()) continue;
        const TriangleMesh& exact = reference->second.mesh;
        TriangleMesh moved = mesh;
        flow.move_vertices(moved);
        const NormalDistance all = normal_distance(moved, exact);
        const NormalDistance sound = normal_distance(moved, exact, reference->second.left_out);
        print_row(depth, configuration, step, all.rms / unit, all.worst / unit, sound.rms / unit,
                  sound.worst / unit, sound.covered, normal_distance(mesh, exact).rms / unit,
                  iterations, stopwatch.seconds());
    }
}

void run(const Options& options) {
    print_row("depth", "configuration", "steps", "rms", "worst", "sound_rms", "sound_worst",
              "sound_part", "moved", "iterations", "seconds");
    const TriangleMesh mesh = named_mesh(options.mesh);
    const std::map<int, Reference> references =
        cotangent_flow(mesh, options.step_size, options.steps);
    for (const int depth : options.depths) {
        for (const std::string& configuration : options.configurations) {
            measure(mesh, references, options, depth, configuration);
        }
    }
}

}  // namespace

void add_accuracy(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "accuracy",
        "Distance along the normal to the cotangent flow, in diagonals of the initial bounding "
        "box: of all vertices, and of those where the cotangent flow's triangles are sound. "
        "Boundaries are free in both. 'moved' is the distance of the initial mesh.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--depths", options->depths)->required();
    command->add_option("--steps", options->steps, "measure after so many")->required();
    command->add_option("--configurations", options->configurations)->required();
    command->add_option("--step-size", options->step_size);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
