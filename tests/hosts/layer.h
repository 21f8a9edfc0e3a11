#pragma once

#include <array>
#include <vector>

#include "meshlab_api.h"

namespace tracked_mcf {

/// A bumpy torus with every attribute that a layer can carry, each with values of its own, and some
/// vertices and faces selected.
void make_layer(MeshModel& layer);

/// Deletes the first vertex and its faces, and puts the vertex out of place, to see that nobody
/// looks at it. The elements stay in memory, as filters leave them.
void delete_first_vertex(MeshModel& layer);

using PositionBits = std::array<unsigned char, 3 * sizeof(Scalarm)>;

/// The positions' bits, deleted vertices included.
std::vector<PositionBits> position_bits(const MeshModel& layer);

/// Everything of a layer but positions, normals and box: what the filter has no business with.
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
