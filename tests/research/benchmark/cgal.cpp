// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/research/benchmark/subcommands.h"

#ifdef TRACKED_MCF_WITH_CGAL

#include <CGAL/Polygon_mesh_processing/smooth_shape.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"

namespace tracked_mcf::benchmark {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Options {
    std::string mesh;
    double step_size = 5e-4;
};

void add_vertex(const Eigen::Vector3d& p, SurfaceMesh& mesh) {
    mesh.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
}

SurfaceMesh surface_mesh(const TriangleMesh& mesh) {
    SurfaceMesh surface;
    for (const Eigen::Vector3d& p : mesh.positions) add_vertex(p, surface);
    for (const Triangle& t : mesh.triangles) {
        surface.add_face(SurfaceMesh::Vertex_index(static_cast<std::uint32_t>(t[0])),
                         SurfaceMesh::Vertex_index(static_cast<std::uint32_t>(t[1])),
                         SurfaceMesh::Vertex_index(static_cast<std::uint32_t>(t[2])));
    }
    return surface;
}

/// Adds a small distant triangle, which makes the mesh open. smooth_shape scales a closed mesh back
/// to its volume after the step.
TriangleMesh with_boundary(TriangleMesh mesh) {
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back(2, 2, 2);
    mesh.positions.emplace_back(2.01, 2, 2);
    mesh.positions.emplace_back(2, 2.01, 2);
    mesh.triangles.push_back({first, first + 1, first + 2});
    return mesh;
}

/// Measures one step only: smooth_shape keeps the stiffness of the first step.
void run(const Options& options) {
    const TriangleMesh mesh = named_mesh(options.mesh);
    print_header();
    const ProcessStopwatch setting_up;
    SurfaceMesh surface = surface_mesh(with_boundary(mesh));
    print_seconds("setup", 0, setting_up.seconds());
    const ProcessStopwatch stopwatch;
    // CGAL's mass is half of ours, its stiffness twice ours.
    CGAL::Polygon_mesh_processing::smooth_shape(surface, options.step_size / 4);
    print_seconds("step", 1, stopwatch.seconds());
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    std::vector<Eigen::Vector3d> positions;
    for (const auto vertex : surface.vertices()) {
        if (vertex.idx() == mesh.positions.size()) break;
        const Kernel::Point_3& p = surface.point(vertex);
        positions.emplace_back(p.x(), p.y(), p.z());
    }
    print_sphere_error(options.mesh, positions, options.step_size, 1);
}

}  // namespace

void add_cgal(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("cgal", "Measures one step of CGAL's smooth_shape.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--step-size", options->step_size);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark

#else

namespace tracked_mcf::benchmark {

void add_cgal(CLI::App& /*app*/) {}

}  // namespace tracked_mcf::benchmark

#endif
