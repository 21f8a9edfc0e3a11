// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/research/experiments/csv.h"
#include "tests/research/experiments/experiments.h"
#include "tests/research/experiments/method.h"
#include "tests/research/experiments/options.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

struct StageOptions : Options {
    std::string method = "tracked";
    std::filesystem::path folder;
};

bool all_finite(const TriangleMesh& mesh) {
    return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const Eigen::Vector3d& position) { return position.allFinite(); });
}

/// Returns the bounding box of the boundary, empty for a closed mesh.
Eigen::AlignedBox3d bounding_box_of_boundary(const TriangleMesh& mesh) {
    const Surface surface = surface_of(mesh);
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < surface.stars.on_rim.size(); ++i) {
        if (surface.stars.on_rim[i] != 0) box.extend(mesh.positions[surface.mesh_vertices[i]]);
    }
    return box;
}

/// Returns the largest distance of a vertex from a box, 0 if the box is empty.
double distance_outside(const Eigen::AlignedBox3d& box, const TriangleMesh& mesh) {
    if (box.isEmpty()) return 0;
    double distance = 0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        distance = std::max(distance, box.exteriorDistance(position));
    }
    return distance;
}

/// Runs all configurations on one mesh.
class Runner {
public:
    explicit Runner(const StageOptions& options)
        : options_(options),
          file_(options.mesh),
          mesh_(file_.triangle_mesh()),
          box_(bounding_box(mesh_)),
          boundary_box_(bounding_box_of_boundary(mesh_)) {}

    void run() {
        int index = 0;
        options_.for_each_case([&](int depth, const std::string& configuration) {
            flow(configuration, options_.parameters(depth, configuration, longest_side(mesh_)),
                 index++);
        });
    }

private:
    void flow(const std::string& configuration, const FlowParameters& parameters, int index) {
        const std::int64_t resident = resident_memory_bytes();
        const std::unique_ptr<Method> method = make_method(options_.method, mesh_, parameters);
        int made = 0;
        bool goes_on = true;
        for (int step = 1; step <= options_.last_step(); ++step) {
            goes_on = goes_on && method->step();
            if (goes_on) made = step;
            if (!options_.measures_after(step)) continue;
            TriangleMesh moved = mesh_;
            method->move(moved);
            print(configuration, step, made, method->report(), peak_memory_bytes() - resident,
                  moved);
            save(moved, index, step);
        }
    }

    void print(const std::string& configuration, int step, int made, const MethodReport& report,
               std::int64_t memory, const TriangleMesh& moved) const {
        const double diagonal = box_.diagonal().norm();
        print_row(report.depth, options_.step_size, configuration, options_.method, step, made,
                  all_finite(moved) ? 1 : 0, surface_area(moved) / surface_area(mesh_),
                  shapes::volume(moved) / shapes::volume(mesh_),
                  distance_outside(box_, moved) / diagonal,
                  distance_outside(boundary_box_, moved) / diagonal, report.collapsed,
                  report.iterations, report.reached_tolerance ? 1 : 0, report.residual,
                  report.unknowns, mesh_.positions.size(), report.split_triangles,
                  report.setup_seconds, report.assemble_seconds, report.solve_seconds, memory);
    }

    void save(const TriangleMesh& moved, int index, int step) {
        if (options_.folder.empty()) return;
        std::filesystem::create_directories(options_.folder);
        const std::string name = std::to_string(index) + "_" + std::to_string(step) + ".ply";
        std::ofstream out(options_.folder / name, std::ios::binary);
        file_.write(moved, out, name);
    }

    StageOptions options_;
    MeshFile file_;
    TriangleMesh mesh_;
    Eigen::AlignedBox3d box_, boundary_box_;  ///< of the initial mesh, and of its boundary
};

void run(const StageOptions& options) {
    print_row("depth", "step_size", "configuration", "method", "steps", "steps_made", "finite",
              "area", "volume", "outside", "beyond_boundary", "collapsed", "iterations",
              "reached_tolerance", "residual", "unknowns", "vertices", "split_triangles",
              "setup_seconds", "assemble_seconds", "solve_seconds", "memory_bytes");
    Runner(options).run();
}

}  // namespace

void add_stages(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "stages",
        "Prints stages of the flow of a file: the area and the enclosed volume relative to the "
        "start. 'outside' is the largest distance of a vertex from the initial "
        "bounding box, 'beyond_boundary' that from the bounding box of the boundary, 0 for a "
        "closed mesh; both in diagonals of the initial box. 'collapsed' is a fraction of the "
        "samples, the residual is that of the last step, relative to its start; iterations and "
        "seconds, which are the processor's, are those of all steps; the memory is the process's "
        "peak, less what it had before the set-up. "
        "'steps_made' is smaller than 'steps' if the flow stopped.",
        run, with_defaults<StageOptions>({1}, 1e-2));
    command->add_option("--method", options->method, "see method.h");
    command->add_option(
        "--folder", options->folder,
        "write the surfaces there as INDEX_STEPS.ply, with the index of depth and configuration");
}

}  // namespace tracked_mcf::experiments
