// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tracked_mcf {

/// Vertex indices of a triangle.
using Triangle = std::array<std::int32_t, 3>;

/// A triangle mesh in the user's units. Several parts, non-manifold edges, inconsistent
/// orientation, soups of unconnected triangles, unreferenced vertices and some degenerate triangles
/// are all allowed.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> positions;  ///< one per vertex
    std::vector<Triangle> triangles;         ///< indices into positions
    /// Whether the positions are floats, to which whoever keeps them rounds the result. Only
    /// NoiseParameters::largest_movement depends on it: it holds after the rounding.
    bool single_precision = false;
};

/// One flag per triangle of a mesh: nonzero if the triangle flows. Empty if all triangles flow.
using Selection = std::vector<std::uint8_t>;

/// What a call takes besides the mesh and the parameters: data of the mesh's triangles and
/// vertices.
struct Inputs {
    Inputs(Selection selected = {}, std::vector<double> strengths = {})
        : selection(std::move(selected)), strength(std::move(strengths)) {}

    Selection selection;
    /// Per vertex: a number from 0 to 1 that multiplies the detail size; empty if all are 1. At 0,
    /// a vertex is held. Coincident vertices, and those across a crack, take the strength of the
    /// one that comes first in the mesh.
    std::vector<double> strength;
};

/// Throws InvalidMesh if there are so many vertices that 32 bits cannot count them with a sign, or
/// so many triangles that they cannot count the corners without one.
void check_size(std::size_t vertices, std::size_t triangles);

/// Throws InvalidMesh unless the mesh has vertices and triangles, all indices are in range, and all
/// vertices that triangles use are finite. Unreferenced vertices are not checked.
void validate(const TriangleMesh& mesh);

/// Throws the same and InvalidMesh if no triangle is selected, or if the strength of a vertex that
/// triangles use is not from 0 to 1; InvalidParameter if the inputs are not as many as triangles or
/// vertices.
void validate(const TriangleMesh& mesh, const Inputs& inputs);

}  // namespace tracked_mcf
