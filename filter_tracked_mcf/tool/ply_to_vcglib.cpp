#include "filter_tracked_mcf/tool/ply_to_vcglib.h"

#include <wrap/io_trimesh/io_mask.h>

#include <array>

namespace tracked_mcf {

using vcg::tri::io::Mask;

namespace {

/// Which channel of a colour a property is, or -1.
int channel_of(const PlyProperty& property) {
    constexpr std::array<std::string_view, 4> names = {"red", "green", "blue", "alpha"};
    if (property.type != PlyType::UInt8 || property.is_list()) return -1;
    std::string_view name = property.name;
    constexpr std::string_view prefix = "diffuse_";
    if (name.substr(0, prefix.size()) == prefix) name.remove_prefix(prefix.size());
    for (int channel = 0; channel < 4; ++channel) {
        if (name == names[static_cast<std::size_t>(channel)]) return channel;
    }
    return -1;
}

int add_vertices(const PlyDocument& document, VcglibMesh& mesh) {
    vcg::tri::Allocator<VcglibMesh>::AddVertices(mesh, document.positions().size());
    for (std::size_t i = 0; i < mesh.vert.size(); ++i) {
        const Eigen::Vector3d& p = document.positions()[i];
        mesh.vert[i].P() = {p.x(), p.y(), p.z()};
        mesh.vert[i].C() = vcg::Color4b(vcg::Color4b::White);
        mesh.vert[i].T() = {0, 0};
    }
    int mask = Mask::IOM_VERTCOORD;
    document.vertices().for_each_field(
        [&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
            if (property.is_list()) return;
            const double number = number_at(bytes.data(), property.type);
            const int channel = channel_of(property);
            if (channel >= 0) {
                mesh.vert[row].C()[channel] = static_cast<unsigned char>(number);
                mask |= Mask::IOM_VERTCOLOR;
            } else if (property.name == "s" || property.name == "texture_u") {
                mesh.vert[row].T().u() = static_cast<float>(number);
                mask |= Mask::IOM_VERTTEXCOORD;
            } else if (property.name == "t" || property.name == "texture_v") {
                mesh.vert[row].T().v() = static_cast<float>(number);
            }
        });
    return mask;
}

/// The triangles of polygon i are triangles first[i] to first[i + 1] - 1.
using FirstTriangles = std::vector<std::size_t>;

FirstTriangles add_fans(const Polygons& polygons, VcglibMesh& mesh) {
    FirstTriangles first{0};
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        first.push_back(first.back() + polygons.corner_count(i) - 2);
    }
    vcg::tri::Allocator<VcglibMesh>::AddFaces(mesh, first.back());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const std::int32_t* const corners = &polygons.corners[polygons.first[i]];
        const auto vertex = [&](std::size_t corner) {
            return &mesh.vert[static_cast<std::size_t>(corners[corner])];
        };
        const std::size_t count = first[i + 1] - first[i];
        for (std::size_t k = 0; k < count; ++k) {
            auto& face = mesh.face[first[i] + k];
            face.V(0) = vertex(0);
            face.V(1) = vertex(k + 1);
            face.V(2) = vertex(k + 2);
            face.C() = vcg::Color4b(vcg::Color4b::White);
            // Edges within the polygon are no edges of the file.
            if (k > 0) face.SetF(0);
            if (k + 1 < count) face.SetF(2);
        }
    }
    return first;
}

/// Two numbers for each corner of the polygon that the triangles from `first` to `last` make up.
void set_texture_coordinates(const PlyProperty& list, const char* numbers, std::size_t first,
                             std::size_t last, VcglibMesh& mesh) {
    const auto number = [&](std::size_t i) {
        return static_cast<float>(number_at(numbers + i * size_of(list.type), list.type));
    };
    for (std::size_t triangle = first; triangle < last; ++triangle) {
        const std::size_t k = triangle - first;
        const std::array<std::size_t, 3> corners = {0, k + 1, k + 2};
        for (int j = 0; j < 3; ++j) {
            const std::size_t corner = corners[static_cast<std::size_t>(j)];
            mesh.face[triangle].WT(j).u() = number(2 * corner);
            mesh.face[triangle].WT(j).v() = number(2 * corner + 1);
        }
    }
}

int add_faces(const PlyDocument& document, VcglibMesh& mesh) {
    const Polygons& polygons = document.polygons();
    const FirstTriangles first = add_fans(polygons, mesh);
    const auto texture_count = static_cast<double>(mesh.textures.size());
    for (auto& face : mesh.face) {
        for (int j = 0; j < 3; ++j) face.WT(j) = {0, 0};
    }
    int mask = Mask::IOM_FACEINDEX;
    document.faces().for_each_field(
        [&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
            const std::size_t begin = first[row], end = first[row + 1];
            const int channel = channel_of(property);
            if (channel >= 0) {
                const double number = number_at(bytes.data(), property.type);
                for (std::size_t i = begin; i < end; ++i) {
                    mesh.face[i].C()[channel] = static_cast<unsigned char>(number);
                }
                mask |= Mask::IOM_FACECOLOR;
            } else if (property.name == "texcoord" && property.is_list()) {
                mask |= Mask::IOM_WEDGTEXCOORD;
                if (list_length(property, bytes.data()) != 2 * polygons.corner_count(row)) return;
                const char* const numbers = bytes.data() + size_of(property.count_type);
                set_texture_coordinates(property, numbers, begin, end, mesh);
            } else if (property.name == "texnumber" && !property.is_list()) {
                const double number = number_at(bytes.data(), property.type);
                if (!(number >= 0 && number < texture_count)) return;
                for (std::size_t i = begin; i < end; ++i) {
                    for (int j = 0; j < 3; ++j) mesh.face[i].WT(j).n() = static_cast<short>(number);
                }
            }
        });
    return mask;
}

}  // namespace

int ply_to_vcglib(const PlyDocument& document, VcglibMesh& mesh) {
    mesh.textures = document.textures();
    const int mask = add_vertices(document, mesh);
    return mask | add_faces(document, mesh);
}

}  // namespace tracked_mcf
