// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/options.h"
#include "tests/support/plans.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

/// The gap as a fraction of a cell, and the grid's side relative to the longest side (grid.h).
constexpr double kGap = 0.25;
constexpr double kCubeToModel = 1.1;

struct Pieces {
    std::string name;
    TriangleMesh first, second;
};

TriangleMesh sphere(int frequency, const Vector3d& center, double radius) {
    return shapes::transformed(shapes::geodesic_sphere(frequency),
                               Eigen::Translation3d(center) * Eigen::Scaling(radius));
}

/// Two spheres side by side along an axis without symmetry near the x axis.
Pieces two_spheres(int depth) {
    constexpr double radius = 0.7;
    const Vector3d axis = Vector3d(1, 0.05, 0.03).normalized();
    // The longest side is (1 + gap + radius) axis_x + 1 + radius. The gap is a fraction of it.
    const double part = std::ldexp(kGap * kCubeToModel, -depth);
    const double gap = part * (1 + radius) * (1 + axis[0]) / (1 - part * axis[0]);
    return {"two spheres", sphere(48, Vector3d::Zero(), 1),
            sphere(40, (1 + gap + radius) * axis, radius)};
}

/// The patch is 3 by 3. It is turned slightly, so that its sides do not lie in grid planes.
Pieces sphere_above_plane(int depth) {
    const double angle = 0.1;
    const double side = 3 * (std::cos(angle) + std::sin(angle));
    const double gap = std::ldexp(kGap * kCubeToModel * side, -depth);
    const Affine3d placed = Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::Scaling(3.0) *
                            Eigen::Translation3d(-0.5, -0.5, 0);
    return {"sphere above plane", sphere(48, Vector3d(0.02, 0.03, 1 + gap), 1),
            shapes::transformed(shapes::square(100), placed)};
}

struct Flowed {
    TriangleMesh mesh;
    bool reached_tolerance = true;
};

/// `step_size` is absolute, so that a piece flows alike alone and together.
Flowed flowed(TriangleMesh mesh, FlowParameters parameters, const Grid& grid, double step_size,
              int steps) {
    parameters.step_size = step_size / std::pow(longest_side(mesh), 2);
    Flow flow(plan_of(mesh, parameters, grid));
    Flowed result;
    for (int i = 0; i < steps; ++i) {
        flow.step();
        result.reached_tolerance &= flow.report().steps.back().reached_tolerance;
    }
    flow.move_vertices(mesh.positions);
    result.mesh = std::move(mesh);
    return result;
}

void measure(const Pieces& pieces, int depth, const Options& options,
             const std::string& configuration) {
    const FlowParameters parameters = options.parameters(depth, configuration);
    const TriangleMesh both = shapes::merged(pieces.first, pieces.second);
    const Grid grid = enclosing_grid(both, depth);
    const double step_size = options.step_size() * std::pow(longest_side(both), 2);
    const auto flow = [&](const TriangleMesh& mesh) {
        return flowed(mesh, parameters, grid, step_size, options.last_step());
    };
    const Flowed together = flow(both);
    const Flowed first = flow(pieces.first);
    const Flowed second = flow(pieces.second);
    const TriangleMesh apart = shapes::merged(first.mesh, second.mesh);
    const bool reached =
        together.reached_tolerance && first.reached_tolerance && second.reached_tolerance;
    print_row(pieces.name, depth, configuration,
              worst_distance(together.mesh, apart) / diagonal(both),
              worst_distance(apart, both) / diagonal(both), reached ? 1 : 0);
}

void run(const Options& options) {
    print_row("pieces", "depth", "configuration", "difference", "moved", "reached_tolerance");
    for (const int depth : options.depths) {
        for (const Pieces& pieces : {two_spheres(depth), sphere_above_plane(depth)}) {
            for (const std::string& configuration : options.configurations) {
                measure(pieces, depth, options, configuration);
            }
        }
    }
}

}  // namespace

void add_pieces(CLI::App& app) {
    add_experiment(
        app, "pieces",
        "Flows two disjoint pieces, a quarter of a cell apart. Prints the largest difference of a "
        "vertex between flowing both together and each alone on the same grid, in diagonals.",
        run, with_defaults({5}, 1e-4));
}

}  // namespace tracked_mcf::experiments
