// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <string>
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

using Eigen::Vector3d;

struct Shape {
    std::string name;
    TriangleMesh mesh;
    Grid grid;
};

/// Returns a grid of the cube [-1, 1]³.
Grid centred_grid(int depth) {
    Grid grid;
    grid.depth = depth;
    grid.cell_size = std::ldexp(2.0, -depth);
    grid.origin = Vector3d::Constant(-1);
    return grid;
}

TriangleMesh centred_box(int n, const Vector3d& sizes) {
    return shapes::transformed(shapes::box(n, sizes),
                               Eigen::Affine3d(Eigen::Translation3d(-sizes / 2)));
}

/// A box projected to a ball: unlike the geodesic sphere, it has edges in the planes of symmetry
/// and vertices on grid lines.
TriangleMesh box_sphere(int n, double radius) {
    TriangleMesh mesh = centred_box(n, Vector3d::Ones());
    for (Vector3d& position : mesh.positions) position = radius * position.normalized();
    return mesh;
}

std::vector<Shape> shapes_on_grids(int depth) {
    const Grid grid = centred_grid(depth);
    const TriangleMesh sphere = shapes::geodesic_sphere(40);
    return {
        // Faces in grid planes, edges and diagonals on and between grid lines.
        {"cube in grid planes", centred_box(32, Vector3d::Ones()), grid},
        {"box in grid planes", centred_box(20, Vector3d(1.5, 1, 0.5)), grid},
        {"cube between grid planes", centred_box(24, Vector3d::Ones()),
         enclosing_grid(centred_box(24, Vector3d::Ones()), depth)},
        {"geodesic sphere", sphere, enclosing_grid(sphere, depth)},
        {"box sphere", box_sphere(32, 0.75), grid},
    };
}

TriangleMesh flowed(const Shape& shape, FlowParameters parameters, bool separate,
                    const Options& options, std::int64_t& unknowns) {
    parameters.separate_sheets = separate;
    Flow flow(plan_of(shape.mesh, parameters, shape.grid));
    unknowns = flow.report().unknowns;
    for (int i = 0; i < options.last_step(); ++i) flow.step();
    TriangleMesh mesh = shape.mesh;
    flow.move_vertices(mesh.positions);
    return mesh;
}

void run(const Options& options) {
    print_row("shape", "depth", "glued_unknowns", "separated_unknowns", "difference", "moved");
    options.for_each_case([&](int depth, const std::string& configuration) {
        const FlowParameters parameters = options.parameters(depth, configuration);
        for (const Shape& shape : shapes_on_grids(depth)) {
            std::int64_t glued_unknowns = 0;
            std::int64_t separated_unknowns = 0;
            const TriangleMesh glued = flowed(shape, parameters, false, options, glued_unknowns);
            const TriangleMesh separated =
                flowed(shape, parameters, true, options, separated_unknowns);
            print_row(shape.name, depth, glued_unknowns, separated_unknowns,
                      worst_distance(separated, glued) / diagonal(shape.mesh),
                      worst_distance(glued, shape.mesh) / diagonal(shape.mesh));
        }
    });
}

}  // namespace

void add_aligned(CLI::App& app) {
    add_experiment(
        app, "aligned",
        "Flows shapes whose edges lie in grid planes and on grid lines, without two sheets in a "
        "cell. Prints the largest difference of a vertex between separate and glued sheets, in "
        "diagonals.",
        run, with_defaults({5}, 1e-3));
}

}  // namespace tracked_mcf::experiments
