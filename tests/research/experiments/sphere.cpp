// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "tests/research/experiments/csv.h"
#include "tests/research/experiments/experiments.h"
#include "tests/research/experiments/method.h"
#include "tests/research/experiments/options.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct SphereOptions : Options {
    int frequency = 128;
    std::string method = "tracked";
};

struct RadiusError {
    double rms = 0;    ///< over the vertices
    double worst = 0;  ///< of a vertex
};

RadiusError radius_error(const TriangleMesh& mesh, double radius) {
    const auto count = static_cast<double>(mesh.positions.size());
    RadiusError error;
    double squares = 0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const double difference = position.norm() - radius;
        squares += difference * difference / count;
        error.worst = std::max(error.worst, std::abs(difference));
    }
    error.rms = std::sqrt(squares);
    return error;
}

void measure(const TriangleMesh& mesh, const SphereOptions& options, int depth,
             const std::string& configuration) {
    FlowParameters parameters = options.parameters(depth, configuration);
    const std::unique_ptr<Method> method = make_method(options.method, mesh, parameters);
    double radius = 1;
    for (int step = 1; step <= options.last_step() && method->step(); ++step) {
        radius = std::pow(radius, 3) / (radius * radius + 2 * options.step_size);
        if (!options.measures_after(step)) continue;
        TriangleMesh moved = mesh;
        method->move(moved);
        const RadiusError error = radius_error(moved, radius);
        const MethodReport report = method->report();
        print_row(depth, configuration, options.method, step, error.rms, error.worst,
                  report.residual, report.iterations);
    }
}

void run(const SphereOptions& options) {
    print_row("depth", "configuration", "method", "steps", "rms", "worst_vertex", "residual",
              "iterations");
    const TriangleMesh mesh = shapes::geodesic_sphere(options.frequency);
    options.for_each_case([&](int depth, const std::string& configuration) {
        measure(mesh, options, depth, configuration);
    });
}

}  // namespace

void add_sphere(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "sphere",
        "Flows the unit sphere with steps in squared units. Prints errors of the radius against "
        "the exact "
        "semi-implicit one, r(t + δ) = r³ / (r² + 2δ): RMS and largest of the vertices.",
        run, with_defaults<SphereOptions>({100}, 1e-3));
    command->add_option("--frequency", options->frequency);
    command->add_option("--method", options->method, "see method.h");
}

}  // namespace tracked_mcf::experiments
