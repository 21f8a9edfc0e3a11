// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// Vertex indices of a triangle.
using Triangle = std::array<std::int32_t, 3>;

/// A triangle mesh in the user's units. Several components, non-manifold edges, inconsistent
/// orientation, soups of unconnected triangles, unreferenced vertices and some degenerate triangles
/// are all allowed.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> positions;  ///< one per vertex
    std::vector<Triangle> triangles;         ///< indices into positions
    /// Per vertex: a number from 0 to 1 that multiplies the detail size; empty if all are 1. At 0,
    /// a vertex stays. Coincident vertices take the strength of the first.
    // Without the initializer, GCC would warn where a mesh is made of two members.
    std::vector<double> strength = {};  // NOLINT(readability-redundant-member-init)
    /// Whether the positions are floats, to which whoever keeps them rounds the result. Only
    /// NoiseParameters::largest_movement depends on it: it holds after the rounding.
    bool single_precision = false;
};

/// One flag per triangle of a mesh: nonzero if the triangle flows. Empty if all triangles flow.
using Selection = std::vector<std::uint8_t>;

/// Throws InvalidMesh unless the mesh has vertices and triangles, all indices are in range, all
/// vertices that triangles use are finite, and their strengths from 0 to 1. Unreferenced vertices
/// are not checked.
void validate(const TriangleMesh& mesh);

}  // namespace tracked_mcf
