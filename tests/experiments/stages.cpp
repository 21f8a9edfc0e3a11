#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/rescaling.h"
#include "filter_tracked_mcf/tool/mesh_file.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"

namespace tracked_mcf::experiments {

namespace {

struct Options {
    std::string mesh;
    int depth = 0;
    double step_size = 1e-2;
    std::vector<int> steps;
    std::vector<std::string> configurations;
    std::filesystem::path folder;
};

/// Of every vertex: a third of the area of its triangles.
std::vector<double> vertex_areas(const TriangleMesh& mesh) {
    std::vector<double> areas(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::int32_t vertex : t) areas[vertex] += twice_vector_area(mesh, t).norm() / 6;
    }
    return areas;
}

/// How far the vertices are from a sphere about the surface's centroid, relative to the mean
/// radius.
struct Roundness {
    double by_area = 0;    ///< standard deviation, vertices weighted by the area around them
    double by_vertex = 0;  ///< the same, all vertices alike
    double worst = 0;      ///< of a vertex
};

Roundness roundness(const TriangleMesh& mesh) {
    const Eigen::Vector3d centre = surface_centroid(mesh);
    const std::vector<double> areas = vertex_areas(mesh);
    std::vector<double> radii;
    for (const Eigen::Vector3d& position : mesh.positions) {
        radii.push_back((position - centre).norm());
    }
    const auto deviation = [&](const auto& weight_of, double& mean) {
        double sum = 0;
        double first = 0;
        double second = 0;
        for (std::size_t i = 0; i < radii.size(); ++i) {
            sum += weight_of(i);
            first += weight_of(i) * radii[i];
            second += weight_of(i) * radii[i] * radii[i];
        }
        mean = first / sum;
        return std::sqrt(std::max(0.0, second / sum - mean * mean)) / mean;
    };
    Roundness result;
    double mean = 0;
    result.by_vertex = deviation([&](std::size_t i) { return areas[i] > 0 ? 1.0 : 0.0; }, mean);
    result.by_area = deviation([&](std::size_t i) { return areas[i]; }, mean);
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (areas[i] > 0) result.worst = std::max(result.worst, std::abs(radii[i] / mean - 1));
    }
    return result;
}

bool all_finite(const TriangleMesh& mesh) {
    return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const Eigen::Vector3d& position) { return position.allFinite(); });
}

/// Runs all configurations on one mesh.
class Runner {
public:
    explicit Runner(const Options& options)
        : options_(options), file_(options.mesh), mesh_(file_.triangle_mesh()) {}

    void run() {
        for (std::size_t i = 0; i < options_.configurations.size(); ++i) run_configuration(i);
    }

private:
    void run_configuration(std::size_t index) {
        FlowParameters parameters = parse_configuration(options_.configurations[index]);
        parameters.depth = options_.depth;
        parameters.step_size = options_.step_size;
        try {
            flow(parameters, index);
        } catch (const NumericalFailure& failure) {
            std::cerr << options_.configurations[index] << ": " << failure.what() << '\n';
        }
    }

    void flow(const FlowParameters& parameters, std::size_t index) {
        std::optional<Rescaler> rescaler;
        if (parameters.rescale != Rescaling::None) rescaler.emplace(mesh_, Selection{}, parameters);
        Flow flow(mesh_, parameters);
        const int last = *std::max_element(options_.steps.begin(), options_.steps.end());
        bool goes_on = true;
        for (int step = 1; step <= last; ++step) {
            goes_on = goes_on && flow.step() && (!rescaler || rescaler->restore(flow));
            if (std::count(options_.steps.begin(), options_.steps.end(), step) == 0) continue;
            TriangleMesh moved = mesh_;
            flow.move_vertices(moved);
            print(options_.configurations[index], step, flow.report(), moved);
            save(moved, index, step);
        }
    }

    void print(const std::string& configuration, int step, const FlowReport& report,
               const TriangleMesh& moved) const {
        const Roundness round = roundness(moved);
        const StepReport last = report.steps.empty() ? StepReport() : report.steps.back();
        print_row(report.depth, options_.step_size, configuration, step,
                  static_cast<int>(report.steps.size()), all_finite(moved) ? 1 : 0, round.by_area,
                  round.by_vertex, round.worst, surface_area(moved) / surface_area(mesh_),
                  static_cast<double>(last.collapsed_samples) / static_cast<double>(report.samples),
                  last.solver_iterations, last.reached_tolerance ? 1 : 0);
    }

    void save(const TriangleMesh& moved, std::size_t index, int step) {
        if (options_.folder.empty()) return;
        std::filesystem::create_directories(options_.folder);
        const std::string name = std::to_string(index) + "_" + std::to_string(step) + ".ply";
        file_.write(moved, options_.folder / name, options_.folder);
    }

    Options options_;
    MeshFile file_;
    TriangleMesh mesh_;
};

}  // namespace

void add_stages(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "stages",
        "Stages of a flow: the area relative to the start, and how near the surface has come to a "
        "sphere: standard deviation of the radius about the surface's centroid over its mean, by "
        "area and by vertex, and the worst vertex; 'collapsed' is a share of the samples, "
        "'steps_made' less than asked for where nothing was left to do.");
    command->add_option("mesh", options->mesh, "a file")->required();
    command->add_option("--depth", options->depth);
    command->add_option("--step-size", options->step_size);
    command->add_option("--steps", options->steps, "measure after so many")->required();
    command->add_option("--configurations", options->configurations)->required();
    command->add_option("--folder", options->folder,
                        "write the surfaces there as NAME_STEPS.ply, NAME being a configuration's "
                        "place in the list");
    command->callback([options] {
        print_row("depth", "step_size", "configuration", "steps", "steps_made", "finite", "by_area",
                  "by_vertex", "worst", "area", "collapsed", "iterations", "reached_tolerance");
        Runner(*options).run();
    });
}

}  // namespace tracked_mcf::experiments
