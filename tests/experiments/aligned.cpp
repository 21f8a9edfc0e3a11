#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/experiments/configuration.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

using Eigen::Vector3d;

struct Options {
    std::vector<int> depths;
    std::string configuration = "converged";
    double step_size = 1e-3;
    int steps = 5;
};

struct Shape {
    std::string name;
    TriangleMesh mesh;
    Grid grid;
};

/// The cube [-1, 1]³, which the grid planes through integers divide.
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

/// A box blown up to a ball: unlike the geodesic sphere, its edges go all along the planes of
/// symmetry, and its corners lie on grid lines.
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
    parameters.step_size = options.step_size;
    Flow flow(shape.mesh, parameters, shape.grid);
    unknowns = flow.report().unknowns;
    for (int i = 0; i < options.steps; ++i) flow.step();
    TriangleMesh mesh = shape.mesh;
    flow.move_vertices(mesh);
    return mesh;
}

void run(const Options& options) {
    print_row("shape", "depth", "glued_unknowns", "separated_unknowns", "difference", "moved");
    const FlowParameters parameters = parse_configuration(options.configuration);
    for (const int depth : options.depths) {
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
    }
}

}  // namespace

void add_aligned(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "aligned",
        "Shapes whose edges lie in grid planes and on grid lines, without two sheets in a cell: "
        "worst difference of a vertex between separated and glued sheets, in diagonals.");
    command->add_option("--depths", options->depths)->required();
    command->add_option("--configuration", options->configuration);
    command->add_option("--step-size", options->step_size);
    command->add_option("--steps", options->steps);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::experiments
