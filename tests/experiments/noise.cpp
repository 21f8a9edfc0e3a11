// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/remove_noise.h"

#include <fstream>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::experiments {

namespace {

struct NoiseOptions : Options {
    std::string output;
    NoiseParameters parameters;
};

/// Writes 24 bytes for each vertex.
void write_positions(const TriangleMesh& mesh, const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    for (const Eigen::Vector3d& position : mesh.positions) {
        file.write(reinterpret_cast<const char*>(position.data()), sizeof position);
    }
}

void run(const NoiseOptions& options) {
    TriangleMesh mesh = named_mesh(options.mesh);
    const ProcessStopwatch watch;
    const NoiseReport report = remove_noise(mesh, {}, options.parameters);
    print_row("noise", "crease_share", "detail_size", "steps", "sharpenings", "iterations", "rms",
              "wall_seconds", "processor_seconds", "peak_bytes");
    print_row(report.noise, report.crease_share, report.detail_size, report.steps,
              report.sharpenings, report.iterations, report.rms_displacement, report.seconds,
              watch.seconds().cpu, peak_memory_bytes());
    if (!options.output.empty()) write_positions(mesh, options.output);
}

}  // namespace

void add_noise(CLI::App& app) {
    const auto [command, options] =
        add_experiment(app, "noise", "Removes the noise of a mesh.", run, NoiseOptions());
    command->add_option("--output", options->output, "File for the positions, 3 doubles each");
    command->add_option("--crease-angle", options->parameters.crease_angle);
    command->add_option("--noise", options->parameters.noise);
    command->add_option("--detail-size", options->parameters.detail_size);
    command->add_option("--largest-movement", options->parameters.largest_movement);
    command->add_option("--threads", options->parameters.threads);
}

}  // namespace tracked_mcf::experiments
