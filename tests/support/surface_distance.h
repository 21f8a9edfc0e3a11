#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// How far two embeddings of one mesh are apart along the normal of the second, mesh units.
struct NormalDistance {
    double rms = 0;      ///< root mean square over the vertices, weighted by the reference's areas
    double worst = 0;    ///< of a vertex
    double covered = 0;  ///< part of the reference's area that was looked at, 0 to 1
};

/// (x - x_reference) · n_reference of all vertices but those that `left_out` marks (of every
/// vertex; empty: none). The meshes have the same triangles. A vertex has the mean normal of its
/// triangles, weighted by area, and a third of their area. Vertices without area do not count.
NormalDistance normal_distance(const TriangleMesh& mesh, const TriangleMesh& reference,
                               const std::vector<std::uint8_t>& left_out = {});

/// Of every vertex: whether one of these triangles (a flag for each) is next to it or next to one
/// of its neighbours. What to leave out where a reference has degenerated.
std::vector<std::uint8_t> vertices_around(const TriangleMesh& mesh,
                                          const std::vector<std::uint8_t>& triangles);

/// The farthest that a vertex of one is from the same vertex of the other, mesh units.
double worst_distance(const TriangleMesh& a, const TriangleMesh& b);

/// Of the bounding box of the vertices that triangles use, mesh units.
double diagonal(const TriangleMesh& mesh);

}  // namespace tracked_mcf
