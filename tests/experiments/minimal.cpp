#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/slip.h"
#include "tests/support/minimal_surfaces.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

constexpr int kAround = 360;
constexpr int kAcross = 48;
constexpr double kEnneperRadius = 0.8;

struct Options {
    std::string surface = "catenoid";
    double ring_distance = 0.8;
    std::vector<double> tilts = {0};
    std::vector<int> depths;
    std::vector<std::string> configurations;
    std::vector<double> step_sizes = {4};
    int steps = 40;
    bool profile = false;
};

/// One of the two surfaces, and what is to become it.
class Surface {
public:
    explicit Surface(const Options& options)
        : catenoid_(options.ring_distance),
          enneper_(kEnneperRadius),
          is_catenoid_(options.surface == "catenoid") {}

    TriangleMesh start() const {
        return is_catenoid_ ? shapes::tube(kAround, kAcross, catenoid_.height())
                            : enneper_.cone(kAround, kAcross);
    }
    double distance(const Eigen::Vector3d& point) const {
        return is_catenoid_ ? std::abs(catenoid_.offset(point)) : enneper_.distance(point);
    }
    /// The best that the grid could do, where it is known: the catenoid along it.
    double chords(const TriangleMesh& moved, const Grid& grid) const {
        return is_catenoid_ ? catenoid_.rms_of_chords(moved.positions, grid) : 0;
    }
    const Catenoid& catenoid() const { return catenoid_; }

private:
    Catenoid catenoid_;
    Enneper enneper_;
    bool is_catenoid_;
};

struct Case {
    double tilt;
    int depth;
    std::string configuration;
    double step_size;
};

void print_distances(const Options& options, const Case& c, const Surface& surface,
                     const TriangleMesh& moved, const Flow& flow) {
    double squares = 0;
    double worst = 0;
    for (const Eigen::Vector3d& position : moved.positions) {
        const double distance = surface.distance(position);
        squares += distance * distance;
        worst = std::max(worst, distance);
    }
    const Slip slip = slip_at_held_edges(flow);
    const Grid& grid = flow.elements().grid;
    int iterations = 0;
    for (const StepReport& step : flow.report().steps) iterations += step.solver_iterations;
    print_row(options.surface, c.tilt, c.depth, c.configuration, c.step_size, options.steps,
              grid.cell_size, std::sqrt(squares / static_cast<double>(moved.positions.size())),
              worst, c.tilt == 0 ? surface.chords(moved, grid) : 0.0, slip.rms, slip.worst,
              iterations);
}

/// The first meridian, and the exact radius there.
void print_profile(const Case& c, const Surface& surface, const TriangleMesh& moved) {
    const TriangleMesh start = surface.start();
    for (std::size_t i = 0; i < moved.positions.size(); ++i) {
        if (start.positions[i][1] != 0 || start.positions[i][0] < 0) continue;
        const Eigen::Vector3d& position = moved.positions[i];
        print_row(c.tilt, c.depth, c.configuration, position[2], position.head<2>().norm(),
                  surface.catenoid().radius(position[2]));
    }
}

void measure(const Options& options, const Case& c) {
    const Surface surface(options);
    const Eigen::Affine3d turn(
        Eigen::AngleAxisd(c.tilt, Eigen::Vector3d(1, 0.3, 0.2).normalized()));
    TriangleMesh mesh = shapes::transformed(surface.start(), turn);
    FlowParameters parameters = parse_configuration(c.configuration);
    parameters.step_size = c.step_size;
    // The cube [-1.1, 1.1]³, whichever way the mesh in it is turned.
    Flow flow(mesh, parameters, with_depth({Eigen::Vector3d::Constant(-1.1), 2.2, 0}, c.depth));
    for (int step = 0; step < options.steps && flow.step(); ++step) {
    }
    flow.move_vertices(mesh);
    const TriangleMesh moved = shapes::transformed(mesh, turn.inverse());
    if (options.profile) {
        print_profile(c, surface, moved);
    } else {
        print_distances(options, c, surface, moved, flow);
    }
}

void run(const Options& options) {
    if (options.profile) {
        print_row("tilt", "depth", "configuration", "z", "radius", "exact");
    } else {
        print_row("surface", "tilt", "depth", "configuration", "step_size", "steps", "cell_size",
                  "rms", "worst", "chords", "slip_rms", "slip_worst", "iterations");
    }
    for (const double tilt : options.tilts) {
        for (const int depth : options.depths) {
            for (const std::string& configuration : options.configurations) {
                for (const double step_size : options.step_sizes) {
                    measure(options, {tilt, depth, configuration, step_size});
                }
            }
        }
    }
}

}  // namespace

void add_minimal(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "minimal",
        "Flows a cylinder between two unit rings to the catenoid, or a cone to Enneper's surface: "
        "distance of the vertices to the exact surface. 'chords' is what the exact catenoid, "
        "linear between the grid's planes, is off by; 'slip' how far the surface has moved at the "
        "held edges.");
    command->add_option("--surface", options->surface)
        ->check(CLI::IsMember({"catenoid", "enneper"}));
    command->add_option("--ring-distance", options->ring_distance);
    command->add_option("--tilts", options->tilts, "radians, about (1, 0.3, 0.2)");
    command->add_option("--depths", options->depths)->required();
    command->add_option("--configurations", options->configurations)->required();
    command->add_option("--step-sizes", options->step_sizes);
    command->add_option("--steps", options->steps);
    command->add_flag("--profile", options->profile, "print a meridian instead");
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
