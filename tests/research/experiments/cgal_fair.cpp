// SPDX-License-Identifier: GPL-3.0-or-later
/// CGAL's fair() as a peer of ours: tracked_mcf_cgal_fair INPUT.ply OUTPUT CONTINUITY
///
/// INPUT's faces have the property "selected". CONTINUITY is 0, 1 or 2. Writes the positions, 3
/// doubles each, and prints seconds (wall, processor) and the peak of the memory in bytes.

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/support/process_time.h"

namespace {

using namespace tracked_mcf;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh::Vertex_index vertex_of(std::int32_t index) {
    return SurfaceMesh::Vertex_index(static_cast<std::uint32_t>(index));
}

/// Returns the vertices that fair() moves, too.
std::vector<SurfaceMesh::Vertex_index> inner_vertices(const TriangleMesh& mesh,
                                                      const Selection& selection,
                                                      const SurfaceMesh& surface) {
    std::vector<char> moves(mesh.positions.size(), 0);
    for (const bool selected : {true, false}) {
        for (std::size_t i = 0; i < selection.size(); ++i) {
            if ((selection[i] != 0) != selected) continue;
            for (const std::int32_t vertex : mesh.triangles[i]) moves[vertex] = selected ? 1 : 0;
        }
    }
    std::vector<SurfaceMesh::Vertex_index> vertices;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const auto vertex = vertex_of(static_cast<std::int32_t>(i));
        if (moves[i] != 0 && !surface.is_border(vertex)) vertices.push_back(vertex);
    }
    return vertices;
}

void run(const std::string& input, const std::string& output, unsigned continuity) {
    MeshFile file(input);
    const TriangleMesh mesh = file.triangle_mesh();
    const Selection selection = file.selection_by("selected");
    SurfaceMesh surface;
    for (const Eigen::Vector3d& p : mesh.positions) {
        surface.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    for (const Triangle& t : mesh.triangles) {
        surface.add_face(vertex_of(t[0]), vertex_of(t[1]), vertex_of(t[2]));
    }
    const auto vertices = inner_vertices(mesh, selection, surface);
    const ProcessStopwatch watch;
    const bool done = CGAL::Polygon_mesh_processing::fair(
        surface, vertices, CGAL::parameters::fairing_continuity(continuity));
    const Seconds seconds = watch.seconds();
    std::ofstream out(output, std::ios::binary);
    for (const SurfaceMesh::Vertex_index vertex : surface.vertices()) {
        const Kernel::Point_3& p = surface.point(vertex);
        const double position[] = {p.x(), p.y(), p.z()};
        out.write(reinterpret_cast<const char*>(position), sizeof position);
    }
    std::cout << done << ' ' << seconds.wall << ' ' << seconds.cpu << ' ' << peak_memory_bytes()
              << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 4) throw std::invalid_argument("give INPUT.ply, OUTPUT and 0, 1 or 2");
        run(argv[1], argv[2], static_cast<unsigned>(std::stoi(argv[3])));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "tracked_mcf_cgal_fair: " << error.what() << '\n';
        return 1;
    }
}
