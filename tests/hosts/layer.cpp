// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hosts/layer.h"

#include <vcg/complex/algorithms/create/platonic.h>

#include <cstring>
#include <limits>
#include <tuple>

namespace tracked_mcf {

namespace {

using vcg::Color4b;

unsigned char byte_of(std::size_t number) {
    return static_cast<unsigned char>(number % 256);
}

void add_bumps(CMeshO& mesh) {
    for (CVertexO& vertex : mesh.vert) {
        const Point3m p = vertex.cP();
        vertex.P() *= 1 + Scalarm(0.02) * std::sin(40 * p[0]) * std::sin(40 * p[1] + 7 * p[2]);
    }
}

/// Texture coordinates are floats in either precision.
vcg::Point2f texture(std::size_t u, int v) {
    return {static_cast<float>(u) / 4, static_cast<float>(v)};
}

void dress_vertices(CMeshO& mesh) {
    for (std::size_t i = 0; i < mesh.vert.size(); ++i) {
        CVertexO& vertex = mesh.vert[i];
        const auto number = static_cast<Scalarm>(i);
        vertex.C() = Color4b(byte_of(i), byte_of(2 * i), byte_of(3 * i), 255);
        vertex.Q() = number / 2;
        vertex.T().P() = texture(i, -1);
        if (i % 7 == 0) vertex.SetS();
    }
}

void dress_faces(CMeshO& mesh) {
    for (std::size_t i = 0; i < mesh.face.size(); ++i) {
        CFaceO& face = mesh.face[i];
        const auto number = static_cast<Scalarm>(i);
        face.C() = Color4b(byte_of(5 * i), byte_of(7 * i), byte_of(11 * i), 255);
        face.Q() = -number;
        for (int corner = 0; corner < 3; ++corner) {
            face.WT(corner).P() = texture(i, corner);
        }
        if (i % 5 == 0) face.SetS();
    }
}

template <class Colour>
void append(std::vector<unsigned char>& colours, const Colour& colour) {
    for (int i = 0; i < 4; ++i) colours.push_back(colour[i]);
}

template <class Texture>
void append(std::vector<Scalarm>& coordinates, const Texture& texture) {
    coordinates.push_back(texture.U());
    coordinates.push_back(texture.V());
}

}  // namespace

void make_layer(MeshModel& layer) {
    vcg::tri::Torus(layer.cm, 2, 1, 60, 30);
    layer.updateDataMask(MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY |
                         MeshModel::MM_VERTTEXCOORD | MeshModel::MM_FACECOLOR |
                         MeshModel::MM_FACEQUALITY | MeshModel::MM_WEDGTEXCOORD);
    add_bumps(layer.cm);
    dress_vertices(layer.cm);
    dress_faces(layer.cm);
    layer.cm.Tr.SetTranslate(1, 2, 3);
    update_box_and_normals(layer);
}

void delete_first_vertex(MeshModel& layer) {
    CMeshO& mesh = layer.cm;
    for (CFaceO& face : mesh.face) {
        const bool uses_it =
            face.V(0) == &mesh.vert[0] || face.V(1) == &mesh.vert[0] || face.V(2) == &mesh.vert[0];
        if (uses_it) vcg::tri::Allocator<CMeshO>::DeleteFace(mesh, face);
    }
    vcg::tri::Allocator<CMeshO>::DeleteVertex(mesh, mesh.vert[0]);
    mesh.vert[0].P() = {std::numeric_limits<Scalarm>::quiet_NaN(), Scalarm(1e30), 0};
}

std::vector<PositionBits> position_bits(const MeshModel& layer) {
    std::vector<PositionBits> result(layer.cm.vert.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        std::memcpy(&result[i], layer.cm.vert[i].cP().V(), sizeof result[i]);
    }
    return result;
}

Belongings::Belongings(const MeshModel& layer) : data_mask(layer.dataMask()) {
    const CMeshO& mesh = layer.cm;
    for (const CVertexO& vertex : mesh.vert) {
        append(vertex_colours, vertex.cC());
        append(texture_coordinates, vertex.cT());
        vertex_qualities.push_back(vertex.cQ());
        vertex_selection.push_back(vertex.IsS());
        vertex_deleted.push_back(vertex.IsD());
    }
    for (const CFaceO& face : mesh.face) {
        append(face_colours, face.cC());
        face_qualities.push_back(face.cQ());
        face_selection.push_back(face.IsS());
        face_deleted.push_back(face.IsD());
        for (int corner = 0; corner < 3; ++corner) {
            append(texture_coordinates, face.cWT(corner));
            face_vertices.push_back(vcg::tri::Index(mesh, face.cV(corner)));
        }
    }
    matrix.assign(mesh.Tr.V(), mesh.Tr.V() + 16);
}

bool Belongings::operator==(const Belongings& other) const {
    const auto all = [](const Belongings& b) {
        return std::tie(b.vertex_colours, b.face_colours, b.vertex_qualities, b.face_qualities,
                        b.texture_coordinates, b.vertex_selection, b.face_selection,
                        b.vertex_deleted, b.face_deleted, b.face_vertices, b.matrix, b.data_mask);
    };
    return all(*this) == all(other);
}

}  // namespace tracked_mcf
