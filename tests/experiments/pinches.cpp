// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/tool/mesh_file.h"
#include "tests/experiments/collapse.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/options.h"
#include "tests/experiments/reference.h"
#include "tests/support/plans.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

struct PinchOptions : Options {
    std::filesystem::path folder;
};

/// Runs all configurations on one mesh.
class Runner {
public:
    explicit Runner(const PinchOptions& options)
        : options_(options),
          file_(options.mesh),
          mesh_(file_.triangle_mesh()),
          references_(cotangent_flow(mesh_, options.step_size(), options.steps)) {}

    void run() {
        for (const auto& [steps, reference] : references_) {
            save(reference.mesh, "cotangent", steps);
            print("cotangent", steps, reference.mesh, {});
        }
        for (std::size_t i = 0; i < options_.configurations.size(); ++i) run_configuration(i);
    }

private:
    void run_configuration(std::size_t index) {
        const std::string& configuration = options_.configurations[index];
        FlowParameters parameters = options_.parameters(options_.depths.front(), configuration);
        parameters.boundary = BoundaryCondition::Free;
        flow(parameters, index);
    }

    void flow(const FlowParameters& parameters, std::size_t index) {
        Flow flow(plan_of(mesh_, parameters));
        Collapse collapse(mesh_);
        for (int step = 1; step <= references_.rbegin()->first; ++step) {
            flow.step();
            TriangleMesh moved = mesh_;
            flow.move_vertices(moved.positions);
            collapse.record(moved);
            if (references_.count(step) == 0) continue;
            print(options_.configurations[index], step, moved, collapse.drift(moved));
            save(moved, std::to_string(index), step);
        }
    }

    void print(const std::string& configuration, int steps, const TriangleMesh& moved,
               const Collapse::Drift& drift) const {
        const Reference& reference = references_.at(steps);
        const double unit = diagonal(mesh_);
        const NormalDistance all = normal_distance(moved, reference.mesh);
        const NormalDistance sound = normal_distance(moved, reference.mesh, reference.left_out);
        const NormalDistance displacement = normal_distance(mesh_, reference.mesh);
        print_row(configuration, 1, steps, all.rms / unit, all.worst / unit, sound.rms / unit,
                  sound.worst / unit, sound.covered, displacement.rms / unit,
                  worst_distance(moved, mesh_) / unit, drift.vertices, drift.rms / unit,
                  drift.worst / unit, outside(moved) / unit, reference.smallest_quality);
    }

    /// Returns the largest distance of a vertex from the initial bounding box. The exact flow stays
    /// inside.
    double outside(const TriangleMesh& moved) const {
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& position : mesh_.positions) box.extend(position);
        double farthest = 0;
        for (const Eigen::Vector3d& position : moved.positions) {
            farthest = std::max(farthest, box.exteriorDistance(position));
        }
        return farthest;
    }

    void save(const TriangleMesh& moved, const std::string& name, int steps) {
        if (options_.folder.empty()) return;
        std::filesystem::create_directories(options_.folder);
        const std::string file = name + "_" + std::to_string(steps) + ".ply";
        std::ofstream out(options_.folder / file, std::ios::binary);
        file_.write(moved, out, file);
    }

    PinchOptions options_;
    MeshFile file_;
    TriangleMesh mesh_;
    std::map<int, Reference> references_;
};

void run(const PinchOptions& options) {
    print_row("configuration", "finite", "steps", "rms", "worst", "sound_rms", "sound_worst",
              "sound_part", "moved", "farthest", "collapsed", "drift_rms", "drift_worst", "outside",
              "smallest_quality");
    Runner(options).run();
}

}  // namespace

void add_pinches(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "pinches",
        "Compares long flows of a file with the cotangent flow, in diagonals of the initial "
        "bounding "
        "box. The distances are those of accuracy. 'farthest' is the largest displacement of a "
        "vertex. 'collapsed' vertices have lost their surface; 'drift' is their movement since "
        "then. "
        "'outside' is the largest distance of a vertex from the initial bounding box. Boundaries "
        "are "
        "free.",
        run, PinchOptions());
    command->add_option("--folder", options->folder,
                        "write the surfaces there as NAME_STEPS.ply; NAME is 'cotangent' or the "
                        "configuration's index");
}

}  // namespace tracked_mcf::experiments
