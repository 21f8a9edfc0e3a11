// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
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

namespace tracked_mcf::experiments {

namespace {

struct CellOptions : Options {
    std::vector<double> box = {0, 0, 0, 1, 1, 1};
    std::filesystem::path folder;
};

using Corners = std::array<Eigen::Vector3d, 8>;

/// The corners of a cell's faces, in order around each; corners are numbered as in bspline.h.
constexpr std::array<std::array<int, 4>, 6> kFaces = {
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

void write_cells(const std::vector<Corners>& cells, const std::filesystem::path& path) {
    std::ofstream file(path);
    file << "ply\nformat ascii 1.0\nelement vertex " << 8 * cells.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
         << 6 * cells.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Corners& corners : cells) {
        for (const Eigen::Vector3d& corner : corners) file << corner.transpose() << '\n';
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (const auto& face : kFaces) {
            file << 4;
            for (const int corner : face) file << ' ' << 8 * i + static_cast<std::size_t>(corner);
            file << '\n';
        }
    }
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

Cell cell_around(const Eigen::Vector3d& position) {
    return position.array().floor().cast<std::int32_t>();
}

Eigen::AlignedBox3d bounding_box(const Corners& corners) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners) box.extend(corner);
    return box;
}

/// One flow, and the cells of its finest level. Positions are in grid units.
class CellFlow {
public:
    explicit CellFlow(const CellOptions& options)
        : options_(options),
          file_(options.mesh),
          mesh_(file_.triangle_mesh()),
          flow_(paper_plan_of(
              mesh_, options.parameters(options.depths.front(), options.configurations.front(),
                                        longest_side(mesh_)))),
          elements_(flow_.elements()),
          identity_(identity_coefficients(elements_)),
          in_patch_(elements_in_patch()) {}

    void run() {
        std::filesystem::create_directories(options_.folder);
        for (int step = 0; step <= options_.last_step(); ++step) {
            if (step > 0 && !flow_.step()) break;
            if (options_.measures_after(step)) measure(step);
        }
    }

private:
    /// Returns a finest element's cell as the flow has deformed it.
    Corners tracked_cell(std::size_t element) const {
        Corners corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::int32_t unknown = elements_.finest().unknowns[element][i];
            corners[i] = (identity_.row(unknown) + flow_.displacement().row(unknown)).transpose();
        }
        return corners;
    }

    static Corners grid_cell(const Cell& cell) {
        Corners corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corners[i] = corner_of(cell, static_cast<int>(i)).cast<double>();
        }
        return corners;
    }

    /// Returns flags, per finest element, of those whose cell has its centre in the patch's box.
    std::vector<bool> elements_in_patch() const {
        Eigen::AlignedBox3d all;
        for (const Eigen::Vector3d& position : mesh_.positions) all.extend(position);
        const auto corner = [&](const double* fractions) {
            const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3d>(fractions);
            return elements_.grid.to_grid(all.min() + at.cwiseProduct(all.sizes()));
        };
        const Eigen::AlignedBox3d box(corner(options_.box.data()), corner(&options_.box[3]));
        std::vector<bool> result;
        for (const MortonCode code : elements_.finest().cells) {
            const Eigen::Vector3d centre =
                cell_at(code).cast<double>() + Eigen::Vector3d::Constant(0.5);
            result.push_back(box.contains(centre));
        }
        return result;
    }

    void measure(int step) const {
        TriangleMesh moved = mesh_;
        flow_.move_vertices(moved.positions);
        std::set<std::array<std::int32_t, 3>> present;
        double outside = 0;
        double outside_initial = 0;
        int vertices = 0;
        int crossed = 0;
        for (std::size_t i = 0; i < moved.positions.size(); ++i) {
            const std::int32_t element = elements_.vertices[i].element;
            if (element == VertexLocation::kNoElement || !in_patch_[element]) continue;
            const Cell initial = cell_at(elements_.finest().cells[element]);
            const Eigen::Vector3d position = elements_.grid.to_grid(moved.positions[i]);
            const Cell now = cell_around(position);
            present.insert({now[0], now[1], now[2]});
            const auto distance = [&](const Corners& corners) {
                return bounding_box(corners).exteriorDistance(position);
            };
            outside = std::max(outside, distance(tracked_cell(element)));
            const double from_initial = distance(grid_cell(initial));
            outside_initial = std::max(outside_initial, from_initial);
            ++vertices;
            crossed += from_initial > 1e-6 ? 1 : 0;
        }
        std::vector<Corners> tracked;
        std::set<std::array<std::int32_t, 3>> initial;
        for (std::size_t element = 0; element < in_patch_.size(); ++element) {
            if (!in_patch_[element]) continue;
            tracked.push_back(tracked_cell(element));
            const Cell cell = cell_at(elements_.finest().cells[element]);
            initial.insert({cell[0], cell[1], cell[2]});
        }
        std::vector<Corners> grid;
        std::size_t fresh = 0;
        for (const auto& [x, y, z] : present) {
            grid.push_back(grid_cell({x, y, z}));
            fresh += initial.count({x, y, z}) == 0 ? 1 : 0;
        }
        print_row(elements_.grid.depth, options_.step_size, step, tracked.size(), grid.size(),
                  fresh, vertices, static_cast<double>(crossed) / vertices, outside,
                  outside_initial);
        write(tracked, "tracked", step);
        write(grid, "grid", step);
        const std::string name = "surface_" + std::to_string(step) + ".ply";
        std::ofstream out(options_.folder / name, std::ios::binary);
        file_.write(moved, out, name);
    }

    void write(std::vector<Corners> cells, const std::string& name, int step) const {
        for (Corners& corners : cells) {
            for (Eigen::Vector3d& corner : corners) {
                corner = elements_.grid.origin + elements_.grid.cell_size * corner;
            }
        }
        write_cells(cells, options_.folder / (name + "_" + std::to_string(step) + ".ply"));
    }

    CellOptions options_;
    MeshFile file_;
    TriangleMesh mesh_;
    PaperFlow flow_;
    const TrackedElements& elements_;
    Coefficients identity_;
    std::vector<bool> in_patch_;
};

void run(const CellOptions& options) {
    print_row("depth", "step_size", "steps", "tracked_cells", "grid_cells", "fresh_grid_cells",
              "vertices", "crossed", "outside", "outside_initial");
    CellFlow(options).run();
}

}  // namespace

void add_cells(CLI::App& app) {
    const auto [command, options] = add_experiment(
        app, "cells",
        "Writes the finest cells that a patch of the surface carries with it in the paper's flow: "
        "tracked_STEPS.ply, the deformed cells; grid_STEPS.ply, the cells of the grid that have "
        "vertices of the patch now; surface_STEPS.ply. Prints how many there are, how many of the "
        "grid's the patch did "
        "not have at the start ('fresh'), the share of vertices that have left their initial cell, "
        "and the largest distance of a vertex from the bounding box of its deformed cell "
        "('outside') and from its initial cell, in sides of a cell.",
        run, with_defaults<CellOptions>({0, 10}, 1e-4));
    command
        ->add_option("--box", options->box,
                     "corners of the patch, in fractions of the bounding box's sides")
        ->expected(6);
    command->add_option("--folder", options->folder, "for the files")->required();
}

}  // namespace tracked_mcf::experiments
