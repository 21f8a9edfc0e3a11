// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/off_file.h"

#include <fstream>
#include <stdexcept>

namespace tracked_mcf {

TriangleMesh read_off(const std::string& path) {
    std::ifstream file(path);
    std::string magic;
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::size_t edges = 0;
    file >> magic >> vertices >> faces >> edges;
    TriangleMesh mesh;
    mesh.positions.resize(vertices);
    mesh.triangles.resize(faces);
    for (auto& p : mesh.positions) file >> p[0] >> p[1] >> p[2];
    for (auto& t : mesh.triangles) {
        int corners = 0;
        file >> corners >> t[0] >> t[1] >> t[2];
        if (corners != 3) throw std::runtime_error(path + " has a face that is not a triangle");
    }
    if (!file || magic != "OFF") throw std::runtime_error("cannot read " + path);
    return mesh;
}

}  // namespace tracked_mcf
