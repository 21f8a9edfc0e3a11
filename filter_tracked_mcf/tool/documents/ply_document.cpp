// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/documents/ply_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ostream>

#include "filter_tracked_mcf/tool/documents/binary.h"
#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

constexpr std::array<std::string_view, 3> kCoordinates = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};
constexpr std::array<std::string_view, 4> kChannels = {"red", "green", "blue", "alpha"};
constexpr std::string_view kQuality = "quality";
constexpr std::string_view kTexture = "comment TextureFile ";

/// Returns the index of a name among `names`, or -1.
template <std::size_t count>
int index_in(const std::array<std::string_view, count>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

/// Returns the channel of a colour that a property is, or -1.
int channel_of(const PlyProperty& property) {
    if (property.type != PlyType::UInt8 || property.is_list()) return -1;
    std::string_view name = property.name;
    constexpr std::string_view prefix = "diffuse_";
    if (name.substr(0, prefix.size()) == prefix) name.remove_prefix(prefix.size());
    return index_in(kChannels, name);
}

bool has_normals(const PlyElement& element) {
    return std::all_of(kNormal.begin(), kNormal.end(), [&](std::string_view name) {
        const PlyProperty* const property = element.find(name);
        return property && !property->is_list();
    });
}

bool names_texture(const std::string& comment) {
    return comment.compare(0, kTexture.size(), kTexture) == 0;
}

/// Appends to `extras` the names of the properties for which `is_known` is false, such as
/// "quality, flags of vertices".
template <class IsKnown>
void append_properties(const PlyElement& element, const char* of, IsKnown is_known,
                       std::vector<std::string>& extras) {
    std::string names;
    for (const PlyProperty& property : element.properties) {
        if (!is_known(property)) names += (names.empty() ? "" : ", ") + property.name;
    }
    if (!names.empty()) extras.push_back(names + of);
}

const PlyElement& element_with_rows(const PlyTable& table, const char* name, const char* plural) {
    const PlyElement* const element = table.find(name);
    if (!element || element->count == 0) {
        throw UnreadableFile(std::string("it has no ") + plural);
    }
    return *element;
}

Points read_positions(const PlyElement& vertices) {
    Points positions(vertices.count);
    for (int axis = 0; axis < 3; ++axis) {
        const auto numbers = vertices.numbers(kCoordinates[static_cast<std::size_t>(axis)]);
        if (numbers.empty()) throw UnreadableFile("its vertices lack a number x, y or z");
        for (std::size_t i = 0; i < numbers.size(); ++i) positions[i][axis] = numbers[i];
    }
    return positions;
}

std::int32_t checked_index(double index, std::size_t vertex_count, std::size_t face) {
    if (index >= 0 && index < static_cast<double>(vertex_count) && index == std::floor(index)) {
        return static_cast<std::int32_t>(index);
    }
    throw UnreadableFile("face " + std::to_string(face) + " refers to vertex " +
                         format_number(index) + " of " + std::to_string(vertex_count) +
                         " (counted from 0)");
}

/// Returns the property of the faces that lists their vertices, or null.
const PlyProperty* find_indices(const PlyElement& faces) {
    const PlyProperty* const indices = faces.find("vertex_indices");
    return indices ? indices : faces.find("vertex_index");
}

Polygons read_polygons(const PlyElement& faces, std::size_t vertex_count) {
    const PlyProperty* const indices = find_indices(faces);
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

/// Returns whether the property is a number that a flow changes.
bool is_computed(const PlyElement& element, const PlyProperty& property) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    return !property.is_list() &&
           ((is_vertex && index_in(kCoordinates, property.name) >= 0) ||
            ((is_vertex || is_face) && index_in(kNormal, property.name) >= 0));
}

/// Returns the file's own type, but double for computed numbers that are neither float nor double
/// in the file, or for all of them if `doubles` is true.
PlyType written_type(const PlyElement& element, const PlyProperty& property, bool doubles) {
    if (!is_computed(element, property)) return property.type;
    return doubles || property.type != PlyType::Float ? PlyType::Double : PlyType::Float;
}

void write_header(std::ostream& out, const PlyTable& table, bool doubles) {
    out << "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : table.comments) out << comment << '\n';
    for (const PlyElement& element : table.elements) {
        out << "element " << element.name << ' ' << element.count << '\n';
        for (const PlyProperty& property : element.properties) {
            out << "property ";
            if (property.is_list()) out << "list " << name_of(property.count_type) << ' ';
            out << name_of(written_type(element, property, doubles)) << ' ' << property.name
                << '\n';
        }
    }
    out << "end_header\n";
}

Points face_normals(const Points& positions, const Polygons& polygons) {
    Points normals;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        normals.push_back(area_vector(positions, polygons, i).stableNormalized());
    }
    return normals;
}

/// Writes the rows of an element with coordinates from `positions`, unless null, and normals from
/// `normals`, unless empty; a zero normal keeps the old one.
void write_rows(std::ostream& out, const PlyElement& element, const Points* positions,
                const Points& normals, bool doubles) {
    struct Source {
        bool computed, is_double;
        int coordinate, normal;  ///< or -1
    };
    std::vector<Source> sources;
    sources.reserve(element.properties.size());
    for (const PlyProperty& property : element.properties) {
        sources.push_back({is_computed(element, property),
                           written_type(element, property, doubles) == PlyType::Double,
                           positions ? index_in(kCoordinates, property.name) : -1,
                           normals.empty() ? -1 : index_in(kNormal, property.name)});
    }
    std::string block;  // a stream takes a few large blocks much faster than many small ones
    constexpr std::size_t block_size = 1 << 16;
    const auto write_field = [&](std::size_t row, const PlyProperty& property,
                                 std::string_view bytes) {
        const Source& source =
            sources[static_cast<std::size_t>(&property - element.properties.data())];
        if (source.computed) {
            double number = number_at(bytes.data(), property.type);
            if (source.coordinate >= 0) number = (*positions)[row][source.coordinate];
            if (source.normal >= 0 && !normals[row].isZero(0)) number = normals[row][source.normal];
            block += source.is_double ? as_bytes(number) : as_bytes(static_cast<float>(number));
        } else {
            block += bytes;
        }
        if (block.size() < block_size) return;
        out << block;
        block.clear();
    };
    element.for_each_field(write_field);
    out << block;
}

}  // namespace

PlyDocument::PlyDocument(PlyTable table) : table_(std::move(table)) {
    positions_ = read_positions(element_with_rows(table_, "vertex", "vertices"));
    polygons_ = read_polygons(element_with_rows(table_, "face", "faces; a surface is needed"),
                              positions_.size());
}

bool PlyDocument::writes_floats() const {
    const auto& properties = vertices().properties;
    return !doubles() && std::all_of(properties.begin(), properties.end(), [](const auto& p) {
        return index_in(kCoordinates, p.name) < 0 || p.type == PlyType::Float;
    });
}

std::vector<Color> PlyDocument::vertex_colors() const {
    std::vector<Color> colors;
    vertices().for_each_field(
        [&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
            const int channel = channel_of(property);
            if (channel < 0) return;
            colors.resize(vertices().count, kWhite);
            colors[row][static_cast<std::size_t>(channel)] =
                static_cast<std::uint8_t>(number_at(bytes.data(), property.type));
        });
    return colors;
}

std::vector<double> PlyDocument::numbers(NumbersOf items, const std::string& name) const {
    return element(items).numbers(name);
}

std::vector<std::string> PlyDocument::property_names(NumbersOf items) const {
    std::vector<std::string> names;
    for (const PlyProperty& property : element(items).properties) {
        if (!property.is_list()) names.push_back(property.name);
    }
    return names;
}

std::vector<std::string> PlyDocument::extras() const {
    std::vector<std::string> extras;
    const auto is_position_or_color = [](const PlyProperty& property) {
        return index_in(kCoordinates, property.name) >= 0 || channel_of(property) >= 0;
    };
    append_properties(vertices(), " of vertices", is_position_or_color, extras);
    const auto is_list_of_corners = [indices = find_indices(faces())](const PlyProperty& property) {
        return &property == indices;
    };
    append_properties(faces(), " of faces", is_list_of_corners, extras);
    for (const PlyElement& element : table_.elements) {
        if (element.name != "vertex" && element.name != "face") extras.push_back(element.name);
    }
    const auto& comments = table_.comments;
    if (std::any_of(comments.begin(), comments.end(), names_texture))
        extras.emplace_back("textures");
    return extras;
}

void PlyDocument::write(std::ostream& out, const Points& positions) const {
    std::optional<PlyTable> with_quality;
    if (!quality().empty()) {
        with_quality = table_;
        for (PlyElement& element : with_quality->elements) {
            if (element.name == "vertex") element.set_numbers(kQuality, quality());
        }
    }
    const PlyTable& table = with_quality ? *with_quality : table_;
    write_header(out, table, doubles());
    for (const PlyElement& element : table.elements) {
        Points normals;
        if (element.name == "vertex") {
            if (has_normals(element)) {
                normals = corner_normals(positions, polygons_, polygons_.corners, positions.size());
            }
            write_rows(out, element, &positions, normals, doubles());
        } else if (element.name == "face") {
            if (has_normals(element)) normals = face_normals(positions, polygons_);
            write_rows(out, element, nullptr, normals, doubles());
        } else {
            out << element.rows;
        }
    }
}

std::unique_ptr<FileDocument> parse_ply(std::string&& content) {
    return std::make_unique<PlyDocument>(parse_ply_table(content));
}

void convert_to_ply(std::ostream& out, const FileDocument& source, const Points& positions) {
    const std::vector<Color> colors = source.vertex_colors();
    const Polygons& polygons = source.polygons();
    std::size_t most_corners = 0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        most_corners = std::max(most_corners, polygons.corner_count(i));
    }
    // Most programs expect the length of the list in one byte.
    const bool short_lists = most_corners < 256;
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << positions.size() << '\n';
    for (const std::string_view name : kCoordinates) out << "property double " << name << '\n';
    for (const std::string_view name : kChannels) {
        if (!colors.empty()) out << "property uchar " << name << '\n';
    }
    const std::vector<double>& quality = source.quality();
    if (!quality.empty()) out << "property double " << kQuality << '\n';
    out << "element face " << polygons.size() << "\nproperty list "
        << (short_lists ? "uchar" : "int") << " int vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < positions.size(); ++i) {
        out << as_bytes(positions[i]);
        if (!colors.empty()) out << as_bytes(colors[i]);
        if (!quality.empty()) out << as_bytes(quality[i]);
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        // In the little-endian order the first byte is the short length.
        const auto count = static_cast<std::int32_t>(polygons.corner_count(i));
        out << as_bytes(count).substr(0, short_lists ? 1 : sizeof count);
        out.write(as_bytes(polygons.corners[polygons.first[i]]).data(),
                  count * static_cast<std::streamsize>(sizeof(std::int32_t)));
    }
}

}  // namespace tracked_mcf
