// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "meshlab_api.h"

namespace tracked_mcf {

/// Adds a bumpy torus with values in every attribute of a layer. Some vertices and faces are
/// selected.
void make_layer(MeshModel& layer);

/// Deletes the first vertex and its faces, and moves the vertex away, so that its use would show.
/// The elements stay in memory, as after MeshLab's own filters.
void delete_first_vertex(MeshModel& layer);

using PositionBits = std::array<unsigned char, 3 * sizeof(Scalarm)>;

/// Returns the bits of the positions, including deleted vertices.
std::vector<PositionBits> position_bits(const MeshModel& layer);

/// Returns all of a layer except positions, normals and box. The filter must not change it.
struct Belongings {
    explicit Belongings(const MeshModel& layer);
    bool operator==(const Belongings& other) const;

    std::vector<unsigned char> vertex_colours, face_colours;
    std::vector<Scalarm> vertex_qualities, face_qualities, texture_coordinates;
    std::vector<bool> vertex_selection, face_selection, vertex_deleted, face_deleted;
    std::vector<std::size_t> face_vertices;
    std::vector<Scalarm> matrix;
    int data_mask;
};

}  // namespace tracked_mcf
