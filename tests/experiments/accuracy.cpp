// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/experiments/reference.h"
#include "tests/support/plans.h"
#include "tests/support/process_time.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

void measure(const TriangleMesh& mesh, const std::map<int, Reference>& references,
             const Options& options, int depth, const std::string& configuration) {
    FlowParameters parameters = options.parameters(depth, configuration);
    parameters.boundary = BoundaryCondition::Free;
    const double unit = diagonal(mesh);
    double start = cpu_seconds();
    Flow flow(plan_of(mesh, parameters));
    double seconds = cpu_seconds() - start;
    int iterations = 0;
    for (int step = 1; step <= references.rbegin()->first; ++step) {
        start = cpu_seconds();
        flow.step();
        seconds += cpu_seconds() - start;
        iterations += flow.report().steps.back().solver_iterations;
        const auto reference = references.find(step);
        if (reference == references.end()) continue;
        const TriangleMesh& exact = reference->second.mesh;
        TriangleMesh moved = mesh;
        flow.move_vertices(moved.positions);
        const NormalDistance all = normal_distance(moved, exact);
        const NormalDistance sound = normal_distance(moved, exact, reference->second.left_out);
        print_row(depth, configuration, step, all.rms / unit, all.worst / unit, sound.rms / unit,
                  sound.worst / unit, sound.covered, normal_distance(mesh, exact).rms / unit,
                  iterations, seconds);
    }
}

void run(const Options& options) {
    print_row("depth", "configuration", "steps", "rms", "worst", "sound_rms", "sound_worst",
              "sound_part", "moved", "iterations", "seconds");
    const TriangleMesh mesh = named_mesh(options.mesh);
    const std::map<int, Reference> references =
        cotangent_flow(mesh, options.step_size(), options.steps);
    options.for_each_case([&](int depth, const std::string& configuration) {
        measure(mesh, references, options, depth, configuration);
    });
}

}  // namespace

void add_accuracy(CLI::App& app) {
    add_experiment(
        app, "accuracy",
        "Prints the distance to the cotangent flow along the normal, in diagonals of the initial "
        "bounding box: for all vertices, and for vertices where the cotangent flow's triangles are "
        "sound. Boundaries are free. 'moved' is the distance of the initial mesh. "
        "Seconds are the processor's, of the set-up and all steps.",
        run, Options());
}

}  // namespace tracked_mcf::experiments
