// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/research/experiments/csv.h"
#include "tests/research/experiments/experiments.h"
#include "tests/research/experiments/options.h"
#include "tests/support/elements.h"
#include "tests/support/measures.h"

namespace tracked_mcf::experiments {

namespace {

struct CellOptions : Options {
    std::filesystem::path folder;
};

/// Writes numbers to a file as they are in memory.
template <class Number>
void write_numbers(const std::vector<Number>& numbers, const std::filesystem::path& path) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

template <class Vector, class Number>
void append(const Vector& vector, std::vector<Number>& numbers) {
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(vector[axis]);
}

/// Returns the eight corners of each finest element's cell as the flow has deformed it.
std::vector<double> tracked_corners(const PaperFlow& flow) {
    const Coefficients corners = identity_coefficients(flow.elements()) + flow.displacement();
    std::vector<double> numbers;
    for (const auto& unknowns : flow.elements().finest().unknowns) {
        for (const std::int32_t unknown : unknowns) append(corners.row(unknown), numbers);
    }
    return numbers;
}

/// Writes what does not change: the finest elements' cells, and each vertex's element.
void write_elements(const TrackedElements& elements, const std::filesystem::path& folder) {
    std::vector<std::int32_t> cells;
    for (const MortonCode code : elements.finest().cells) append(cell_at(code), cells);
    write_numbers(cells, folder / "cells.i32");
    std::vector<std::int32_t> of_vertices;
    for (const VertexLocation& vertex : elements.vertices) of_vertices.push_back(vertex.element);
    write_numbers(of_vertices, folder / "elements.i32");
}

void run(const CellOptions& options) {
    print_row("depth", "step_size", "steps", "x", "y", "z", "cell_size");
    MeshFile file(options.mesh);
    const TriangleMesh mesh = file.triangle_mesh();
    PaperFlow flow(paper_plan_of(
        mesh, options.parameters(options.depths.front(), options.configurations.front(),
                                 longest_side(mesh))));
    const Grid& grid = flow.elements().grid;
    std::filesystem::create_directories(options.folder);
    write_elements(flow.elements(), options.folder);
    for (int step = 0; step <= options.last_step(); ++step) {
        if (step > 0 && !flow.step()) break;
        if (!options.measures_after(step)) continue;
        TriangleMesh moved = mesh;
        flow.move_vertices(moved.positions);
        std::vector<double> vertices;
        for (const Eigen::Vector3d& position : moved.positions) {
            append(grid.to_grid(position), vertices);
        }
        const std::string steps = std::to_string(step);
        write_numbers(vertices, options.folder / ("vertices_" + steps + ".f64"));
        write_numbers(tracked_corners(flow), options.folder / ("corners_" + steps + ".f64"));
        std::ofstream surface(options.folder / ("surface_" + steps + ".ply"), std::ios::binary);
        file.write(moved, surface, "surface.ply");
        print_row(grid.depth, options.step_size, step, grid.origin[0], grid.origin[1],
                  grid.origin[2], grid.cell_size);
    }
}

}  // namespace

void add_cells(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "cells",
        "Writes how the finest elements' cells move with the surface in the paper's flow, in units "
        "of the grid: the initial cells (cells.i32), each vertex's element (elements.i32), and "
        "after some steps the vertices (vertices_STEPS.f64), each element's eight corners "
        "(corners_STEPS.f64), and the surface in its own units (surface_STEPS.ply). Prints the "
        "grid's smallest corner and the side of its cells.",
        run, with_defaults<CellOptions>({0, 10}, 1e-4));
    command->add_option("--folder", options->folder, "for the files")->required();
}

}  // namespace tracked_mcf::experiments
