// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/triangle_mesh.h"

#include <algorithm>
#include <limits>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/plain_text.h"

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
    }
}

template <class Given, class Items>
void check_count(const Given& given, const Items& items, const char* what, const char* of) {
    if (given.empty() || given.size() == items.size()) return;
    throw InvalidParameter("There are " + std::to_string(given.size()) + ' ' + what + " for the " +
                           std::to_string(items.size()) + ' ' + of + "; give one for each.");
}

void check_strengths(const TriangleMesh& mesh, const std::vector<double>& strengths) {
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::int32_t vertex : triangle) {
            const double strength = strengths[vertex];
            if (strength >= 0 && strength <= 1) continue;  // a NaN is not
            throw InvalidMesh("The strength of vertex " + std::to_string(vertex) + " is " +
                              plain(strength, 10) + "; give numbers from 0 to 1.");
        }
    }
}

}  // namespace

void check_size(std::size_t vertices, std::size_t triangles) {
    constexpr std::size_t most_vertices = std::numeric_limits<std::int32_t>::max();
    constexpr std::size_t most_triangles = std::numeric_limits<std::uint32_t>::max() / 3;
    if (vertices <= most_vertices && triangles <= most_triangles) return;
    throw InvalidMesh("The mesh has more than " + std::to_string(most_vertices) + " vertices or " +
                      std::to_string(most_triangles) + " faces; simplify it first.");
}

void validate(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) throw InvalidMesh("The mesh is empty: it has no vertices.");
    if (mesh.triangles.empty()) {
        throw InvalidMesh("The mesh has no faces; the filter needs a surface, not a point cloud.");
    }
    check_size(mesh.positions.size(), mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) check_triangle(mesh, triangle);
}

void validate(const TriangleMesh& mesh, const Inputs& inputs) {
    validate(mesh);
    check_count(inputs.selection, mesh.triangles, "flags of selection", "triangles");
    check_count(inputs.strength, mesh.positions, "strengths", "vertices");
    const auto is_set = [](auto flag) { return flag != 0; };
    const Selection& selection = inputs.selection;
    if (!selection.empty() && std::none_of(selection.begin(), selection.end(), is_set)) {
        throw InvalidMesh("No face is selected; select the faces that are to move.");
    }
    if (!inputs.strength.empty()) check_strengths(mesh, inputs.strength);
}

}  // namespace tracked_mcf
