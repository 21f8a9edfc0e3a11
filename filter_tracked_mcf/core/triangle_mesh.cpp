// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <limits>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

void check_triangle(const TriangleMesh& mesh, const Triangle& triangle) {
    for (const std::int32_t vertex : triangle) {
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.positions.size()) {
            throw InvalidMesh("A triangle refers to vertex " + std::to_string(vertex) +
                              ", which does not exist: the mesh file is damaged.");
        }
        if (!mesh.positions[vertex].allFinite()) {
            throw InvalidMesh("Vertex " + std::to_string(vertex) +
                              " has a coordinate that is not a finite number; remove or repair it "
                              "first.");
        }
        if (mesh.strength.empty()) continue;
        const double strength = mesh.strength[vertex];
        if (!(strength >= 0 && strength <= 1)) {
            throw InvalidMesh("The strength of vertex " + std::to_string(vertex) + " is " +
                              std::to_string(strength) + "; give numbers from 0 to 1.");
        }
    }
}

}  // namespace

void validate(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) throw InvalidMesh("The mesh is empty: it has no vertices.");
    if (mesh.triangles.empty()) {
        throw InvalidMesh("The mesh has no faces; the filter needs a surface, not a point cloud.");
    }
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (mesh.positions.size() > most || mesh.triangles.size() > most) {
        throw InvalidMesh(
            "The mesh has more than 2147483647 vertices or faces; simplify it first.");
    }
    if (!mesh.strength.empty() && mesh.strength.size() != mesh.positions.size()) {
        throw InvalidMesh("There are " + std::to_string(mesh.strength.size()) +
                          " strengths for the " + std::to_string(mesh.positions.size()) +
                          " vertices; give one for each.");
    }
    for (const Triangle& triangle : mesh.triangles) check_triangle(mesh, triangle);
}

}  // namespace tracked_mcf
