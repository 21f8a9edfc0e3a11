// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The distance between two embeddings of one mesh along the normals of the second, in mesh units.
struct NormalDistance {
    double rms = 0;      ///< root mean square over vertices, weighted by the reference's areas
    double worst = 0;    ///< largest distance of a vertex
    double covered = 0;  ///< share of the reference's area that was compared, 0 to 1
};

/// Returns (x - x_reference) · n_reference over all vertices except those that `left_out` flags;
/// empty flags none. The meshes have the same triangles. A vertex has the mean normal of its
/// triangles, weighted by area, and a third of their area. Vertices without area are ignored.
NormalDistance normal_distance(const TriangleMesh& mesh, const TriangleMesh& reference,
                               const std::vector<std::uint8_t>& left_out = {});

/// Returns, per vertex, whether a flagged triangle is next to it or next to one of its neighbours.
/// These are the vertices to leave out where a reference has degenerated.
std::vector<std::uint8_t> vertices_around(const TriangleMesh& mesh,
                                          const std::vector<std::uint8_t>& triangles);

/// Returns the largest distance between a vertex and the same vertex of the other mesh.
double worst_distance(const TriangleMesh& a, const TriangleMesh& b);

/// Returns the root mean square distance between a vertex and the same vertex of the other mesh.
double rms_distance(const TriangleMesh& a, const TriangleMesh& b);

/// Returns the diagonal of the bounding box of the vertices that triangles use.
double diagonal(const TriangleMesh& mesh);

}  // namespace tracked_mcf
