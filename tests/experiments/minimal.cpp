// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/options.h"
#include "tests/experiments/slip.h"
#include "tests/support/minimal_surfaces.h"
#include "tests/support/plans.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

constexpr int kAround = 360;
constexpr int kAcross = 48;
constexpr double kEnneperRadius = 0.8;

struct MinimalOptions : Options {
    std::string surface = "catenoid";
    double ring_distance = 0.8;
    std::vector<double> tilts = {0};
    bool profile = false;
};

/// One of the two minimal surfaces, and the mesh that flows to it.
class Surface {
public:
    explicit Surface(const MinimalOptions& options)
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
    /// Returns the smallest possible error on the grid for a catenoid along an axis, else 0.
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

void print_distances(const MinimalOptions& options, const Case& c, const Surface& surface,
                     const TriangleMesh& moved, const Flow& flow) {
    double squares = 0;
    double worst = 0;
    for (const Eigen::Vector3d& position : moved.positions) {
        const double distance = surface.distance(position);
        squares += distance * distance;
        worst = std::max(worst, distance);
    }
    const Slip slip = slip_at_constrained_edges(flow);
    const Grid& grid = flow.stepper().elements().grid;
    int iterations = 0;
    for (const StepReport& step : flow.report().steps) iterations += step.solver_iterations;
    print_row(options.surface, c.tilt, c.depth, c.configuration, c.step_size, options.last_step(),
              grid.cell_size, std::sqrt(squares / static_cast<double>(moved.positions.size())),
              worst, c.tilt == 0 ? surface.chords(moved, grid) : 0.0, slip.rms, slip.worst,
              iterations);
}

/// Prints the first meridian and the exact radius.
void print_profile(const Case& c, const Surface& surface, const TriangleMesh& moved) {
    const TriangleMesh start = surface.start();
    for (std::size_t i = 0; i < moved.positions.size(); ++i) {
        if (start.positions[i][1] != 0 || start.positions[i][0] < 0) continue;
        const Eigen::Vector3d& position = moved.positions[i];
        print_row(c.tilt, c.depth, c.configuration, position[2], position.head<2>().norm(),
                  surface.catenoid().radius(position[2]));
    }
}

void measure(const MinimalOptions& options, const Case& c) {
    const Surface surface(options);
    const Eigen::Affine3d turn(
        Eigen::AngleAxisd(c.tilt, Eigen::Vector3d(1, 0.3, 0.2).normalized()));
    TriangleMesh mesh = shapes::transformed(surface.start(), turn);
    FlowParameters parameters = options.parameters(c.depth, c.configuration);
    parameters.step_size = c.step_size;
    // The cube [-1.1, 1.1]³ for every rotation of the mesh.
    Flow flow(
        plan_of(mesh, parameters, with_depth({Eigen::Vector3d::Constant(-1.1), 2.2, 0}, c.depth)));
    for (int step = 0; step < options.last_step() && flow.step(); ++step) {
    }
    flow.move_vertices(mesh.positions);
    const TriangleMesh moved = shapes::transformed(mesh, turn.inverse());
    if (options.profile) {
        print_profile(c, surface, moved);
    } else {
        print_distances(options, c, surface, moved, flow);
    }
}

void run(const MinimalOptions& options) {
    if (options.profile) {
        print_row("tilt", "depth", "configuration", "z", "radius", "exact");
    } else {
        print_row("surface", "tilt", "depth", "configuration", "step_size", "steps", "cell_size",
                  "rms", "worst", "chords", "slip_rms", "slip_worst", "iterations");
    }
    for (const double tilt : options.tilts) {
        options.for_each_case([&](int depth, const std::string& configuration) {
            for (const double step_size : options.step_sizes) {
                measure(options, {tilt, depth, configuration, step_size});
            }
        });
    }
}

}  // namespace

void add_minimal(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "minimal",
        "Flows a cylinder between two unit rings to the catenoid, or a cone to Enneper's surface. "
        "Prints the distance of the vertices to the exact surface. 'chords' is the error of the "
        "exact "
        "catenoid interpolated linearly between grid planes. 'slip' is the surface's distance from "
        "the constrained edges.",
        run, with_defaults<MinimalOptions>({40}, 4));
    command->add_option("--surface", options->surface)
        ->check(CLI::IsMember({"catenoid", "enneper"}));
    command->add_option("--ring-distance", options->ring_distance);
    command->add_option("--tilts", options->tilts, "radians, about (1, 0.3, 0.2)");
    command->add_flag("--profile", options->profile, "print a meridian instead");
}

}  // namespace tracked_mcf::experiments
