#include "filter_tracked_mcf/tool/documents/ply_document.h"

#include <array>
#include <ostream>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

constexpr std::array<std::string_view, 3> kCoordinates = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};

/// Which of the three names this is, or -1.
int axis_of(std::string_view name, const std::array<std::string_view, 3>& names) {
    for (int axis = 0; axis < 3; ++axis) {
        if (name == names[static_cast<std::size_t>(axis)]) return axis;
    }
    return -1;
}

bool holds_vector(const PlyElement& element, const std::array<std::string_view, 3>& names) {
    for (const std::string_view name : names) {
        const PlyProperty* const property = element.find(name);
        if (!property || property->is_list()) return false;
    }
    return true;
}

const PlyElement& element_with_rows(const PlyTable& table, const char* name, const char* plural) {
    const PlyElement* const element = table.find(name);
    if (!element || element->count == 0) {
        throw UnreadableFile(std::string("it has no ") + plural);
    }
    return *element;
}

Points read_positions(const PlyElement& vertices) {
    if (!holds_vector(vertices, kCoordinates)) {
        throw UnreadableFile("its vertices lack x, y or z");
    }
    Points positions(vertices.count);
    vertices.for_each_field(
        [&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
            const int axis = axis_of(property.name, kCoordinates);
            if (axis >= 0) positions[row][axis] = number_at(bytes.data(), property.type);
        });
    return positions;
}

std::int32_t checked_index(double index, std::size_t vertex_count, std::size_t face) {
    if (index >= 0 && index < static_cast<double>(vertex_count)) {
        return static_cast<std::int32_t>(index);
    }
    throw UnreadableFile("face " + std::to_string(face) + " refers to vertex " +
                         std::to_string(static_cast<std::int64_t>(index)) + " of " +
                         std::to_string(vertex_count) + " (counted from 0)");
}

Polygons read_polygons(const PlyElement& faces, std::size_t vertex_count) {
    const PlyProperty* indices = faces.find("vertex_indices");
    if (!indices) indices = faces.find("vertex_index");
    if (!indices || !indices->is_list()) throw UnreadableFile("its faces lack vertex_indices");
    Polygons polygons;
    faces.for_each_field([&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
        if (&property != indices) return;
        const std::size_t length = list_length(property, bytes.data());
        const char* at = bytes.data() + size_of(property.count_type);
        for (std::size_t i = 0; i < length; ++i, at += size_of(property.type)) {
            const double index = number_at(at, property.type);
            polygons.corners.push_back(checked_index(index, vertex_count, row));
        }
        polygons.close();
    });
    return polygons;
}

/// What has been computed in doubles is written as doubles, even where it was read as floats: far
/// from the origin these could not hold a smooth surface.
PlyType written_type(const PlyElement& element, const PlyProperty& property) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    const bool computed = (is_vertex && axis_of(property.name, kCoordinates) >= 0) ||
                          ((is_vertex || is_face) && axis_of(property.name, kNormal) >= 0);
    return computed && !property.is_list() ? PlyType::Double : property.type;
}

/// Replaces coordinates by `positions`, unless null, and normals by `normals` where not zero.
void write_rows(std::ostream& out, const PlyElement& element, const Points* positions,
                const Points& normals) {
    const auto write_field = [&](std::size_t row, const PlyProperty& property,
                                 std::string_view bytes) {
        if (property.is_list() || written_type(element, property) != PlyType::Double) {
            out << bytes;
            return;
        }
        double number = number_at(bytes.data(), property.type);
        const int coordinate = positions ? axis_of(property.name, kCoordinates) : -1;
        const int normal = normals.empty() ? -1 : axis_of(property.name, kNormal);
        if (coordinate >= 0) number = (*positions)[row][coordinate];
        if (normal >= 0 && !normals[row].isZero(0)) number = normals[row][normal];
        out.write(reinterpret_cast<const char*>(&number), sizeof number);
    };
    element.for_each_field(write_field);
}

constexpr std::string_view kTexture = "comment TextureFile ";

bool names_texture(const std::string& comment) {
    return comment.compare(0, kTexture.size(), kTexture) == 0;
}

}  // namespace

PlyDocument::PlyDocument(PlyTable table)
    : table_(std::move(table)),
      positions_(read_positions(element_with_rows(table_, "vertex", "vertices"))),
      polygons_(read_polygons(element_with_rows(table_, "face", "faces; a surface is needed"),
                              positions_.size())) {}

bool PlyDocument::has_normals() const {
    return holds_vector(vertices(), kNormal) || holds_vector(faces(), kNormal);
}

std::vector<std::string> PlyDocument::textures() const {
    std::vector<std::string> names;
    for (const std::string& comment : table_.comments) {
        if (names_texture(comment)) names.push_back(comment.substr(kTexture.size()));
    }
    return names;
}

void PlyDocument::write(std::ostream& out, const Points& positions,
                        const FolderChange& change) const {
    write_header(out, change);
    for (const PlyElement& element : table_.elements) {
        if (element.name == "vertex") {
            write_rows(out, element, &positions, vertex_normals(positions));
        } else if (element.name == "face") {
            write_rows(out, element, nullptr, face_normals(positions));
        } else {
            out << element.rows;
        }
    }
}

void PlyDocument::write_header(std::ostream& out, const FolderChange& change) const {
    out << "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : table_.comments) {
        if (names_texture(comment)) {
            out << kTexture << change.relocate(comment.substr(kTexture.size())) << '\n';
        } else {
            out << comment << '\n';
        }
    }
    for (const PlyElement& element : table_.elements) {
        out << "element " << element.name << ' ' << element.count << '\n';
        for (const PlyProperty& property : element.properties) {
            out << "property ";
            if (property.is_list()) out << "list " << name_of(property.count_type) << ' ';
            out << name_of(written_type(element, property)) << ' ' << property.name << '\n';
        }
    }
    out << "end_header\n";
}

Points PlyDocument::vertex_normals(const Points& positions) const {
    if (!holds_vector(vertices(), kNormal)) return {};
    return normals_where_corners_meet(positions, polygons_, polygons_.corners, positions.size());
}

Points PlyDocument::face_normals(const Points& positions) const {
    if (!holds_vector(faces(), kNormal)) return {};
    Points normals;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
        normals.push_back(area_vector(positions, polygons_, i).stableNormalized());
    }
    return normals;
}

std::unique_ptr<MeshDocument> parse_ply(std::string_view content) {
    return std::make_unique<PlyDocument>(parse_ply_table(content));
}

}  // namespace tracked_mcf
