// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "filter_tracked_mcf/hosts/cli/documents/binary.h"
#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/documents/ply_table.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

constexpr std::array<std::string_view, 3> kCoordinates = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> kNormal = {"nx", "ny", "nz"};
constexpr std::string_view kQuality = "quality";

/// What a property means. The axis is that of a point.
struct Role {
    enum Kind { None, Coordinate, Normal, Corners, Strips } kind = None;
    int axis = 0;
};

/// Returns the list of vertices of faces or strips. It has one of the names that programs use, or
/// is the only list of whole numbers.
const PlyProperty& find_indices(const PlyElement& element) {
    for (const char* const name : {"vertex_indices", "vertex_index", "vertex_indexes"}) {
        const PlyProperty* const found = element.find(name);
        if (found && found->is_list()) return *found;
    }
    const PlyProperty* only = nullptr;
    std::size_t count = 0;
    for (const PlyProperty& property : element.properties) {
        if (!property.is_list() || property.type >= PlyType::Float) continue;
        only = &property;
        ++count;
    }
    if (count != 1) throw UnreadableFile("its " + element.name + "s lack vertex_indices");
    return *only;
}

/// Appends the triangles of strips of vertices, which -1 separates. Every other triangle of a strip
/// is turned over. Triangles without area only lead from one part of a strip to the next.
void append_strips(const std::vector<std::int32_t>& vertices, Polygons& triangles) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        length = vertices[i] < 0 ? 0 : length + 1;
        if (length < 3) continue;
        std::array<std::int32_t, 3> corners = {vertices[i - 2], vertices[i - 1], vertices[i]};
        if (length % 2 == 0) std::swap(corners[0], corners[1]);
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        triangles.corners.insert(triangles.corners.end(), corners.begin(), corners.end());
        triangles.close();
    }
}

/// Vertices with x, y, z and faces or tristrips with vertex_indices. The triangles of strips follow
/// the faces.
class PlyDocument : public FileDocument {
public:
    explicit PlyDocument(std::string content)
        : table_(std::move(content)),
          vertices_(table_.find("vertex")),
          faces_(table_.find("face")) {
        const PlyElement* const strips = table_.find("tristrips");
        if (!vertices_) throw UnreadableFile("it has no vertices");
        if (!faces_ && !strips) throw UnreadableFile("it has no faces; a surface is needed");
        roles_.resize(table_.property_count());
        if (!set_roles(vertices_, Role::Coordinate, kCoordinates)) {
            throw UnreadableFile("its vertices lack a number x, y or z");
        }
        vertices_have_normals_ = set_roles(vertices_, Role::Normal, kNormal);
        faces_have_normals_ = set_roles(faces_, Role::Normal, kNormal);
        if (faces_ && faces_->count > 0) roles_[find_indices(*faces_).index].kind = Role::Corners;
        if (strips) roles_[find_indices(*strips).index].kind = Role::Strips;
        read();
    }

    bool writes_floats() const override {
        const auto& properties = vertices_->properties;
        return !doubles() && std::all_of(properties.begin(), properties.end(), [&](const auto& p) {
            return roles_[p.index].kind != Role::Coordinate || p.type == PlyType::Float;
        });
    }

    std::vector<double> numbers(NumbersOf items, const std::string& name) const override {
        const PlyElement* const element = element_of(items);
        const PlyProperty* const wanted = element ? element->find(name) : nullptr;
        std::vector<double> numbers;
        if (!wanted || wanted->is_list()) return numbers;
        table_.for_each_field(
            [&](const PlyElement&, std::size_t, const PlyProperty& property, const Words& words) {
                if (&property == wanted) numbers.push_back(table_.number(words[0], property.type));
            });
        if (element == faces_) numbers.resize(polygons_.size());
        return numbers;
    }

    std::vector<std::string> property_names(NumbersOf items) const override {
        const PlyElement* const element = element_of(items);
        std::vector<std::string> names;
        for (std::size_t i = 0; element && i < element->properties.size(); ++i) {
            if (!element->properties[i].is_list()) names.push_back(element->properties[i].name);
        }
        return names;
    }

    std::vector<std::string> extras() const override {
        std::vector<std::string> extras;
        for (const PlyElement& element : table_.elements()) {
            std::string names;
            bool is_converted = false;
            for (const PlyProperty& property : element.properties) {
                const Role::Kind kind = roles_[property.index].kind;
                if (kind == Role::None || kind == Role::Normal)
                    names += (names.empty() ? "" : ", ") + property.name;
                else
                    is_converted = true;
            }
            if (!is_converted && element.count > 0)
                extras.push_back(element.name);
            else if (!names.empty())
                extras.push_back(names + (&element == vertices_ ? " of vertices" : " of faces"));
        }
        const std::size_t texture = table_.header().find("comment TextureFile ");
        if (texture != std::string_view::npos) extras.emplace_back("textures");
        return extras;
    }

    void write(std::ostream& out, const Points& positions) const override;

private:
    const PlyElement* element_of(NumbersOf items) const {
        return items == NumbersOf::Faces ? faces_ : vertices_;
    }

    /// Sets the roles of the numbers of these names, if the element has all of them.
    bool set_roles(const PlyElement* element, Role::Kind kind,
                   const std::array<std::string_view, 3>& names) {
        std::array<const PlyProperty*, 3> found;
        for (std::size_t i = 0; i < 3; ++i) {
            found[i] = element ? element->find(names[i]) : nullptr;
            if (!found[i] || found[i]->is_list()) return false;
        }
        for (int i = 0; i < 3; ++i) roles_[found[static_cast<std::size_t>(i)]->index] = {kind, i};
        return true;
    }

    void read() {
        Polygons strips;
        std::vector<std::int32_t> vertices;
        positions_.reserve(std::min(vertices_->count, table_.content().size()));
        table_.for_each_field([&](const PlyElement& element, std::size_t row,
                                  const PlyProperty& property, const Words& words) {
            const Role role = roles_[property.index];
            if (&element == vertices_ && positions_.size() == row) {
                positions_.emplace_back(Eigen::Vector3d::Zero());
            }
            if (role.kind == Role::Coordinate) {
                positions_[row][role.axis] = table_.number(words[0], property.type);
            } else if (role.kind == Role::Corners) {
                for (std::size_t i = 1; i < words.size(); ++i) {
                    polygons_.corners.push_back(vertex(words[i], element, row, property, 0));
                }
                polygons_.close();
            } else if (role.kind == Role::Strips) {
                vertices.clear();
                for (std::size_t i = 1; i < words.size(); ++i) {
                    vertices.push_back(vertex(words[i], element, row, property, -1));
                }
                append_strips(vertices, strips);
            } else if (table_.is_text()) {
                for (const std::string_view word : words) parse_number(word);
            }
        });
        for (std::size_t i = 0; i < strips.corners.size(); ++i) {
            polygons_.corners.push_back(strips.corners[i]);
            if (i % 3 == 2) polygons_.close();
        }
    }

    std::int32_t vertex(std::string_view word, const PlyElement& element, std::size_t row,
                        const PlyProperty& property, int lowest) const {
        const double vertex = table_.number(word, property.type);
        const auto count = static_cast<double>(vertices_->count);
        const auto index =
            static_cast<std::int32_t>(vertex >= lowest && vertex < count ? vertex : -2);
        if (index == vertex && index >= lowest) return index;
        throw UnreadableFile(element.name + ' ' + std::to_string(row) + " refers to vertex " +
                             format_number(vertex) + " of " + format_number(count) +
                             " (counted from 0)");
    }

    PlyTable table_;
    const PlyElement *vertices_, *faces_;  ///< faces_ is null if there are only strips
    std::vector<Role> roles_;              ///< by PlyProperty::index
    bool vertices_have_normals_ = false, faces_have_normals_ = false;
};

void PlyDocument::write(std::ostream& out, const Points& positions) const {
    std::vector<std::int32_t> polygon_of_corner;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
        polygon_of_corner.resize(polygons_.first[i + 1], static_cast<std::int32_t>(i));
    }
    const auto normals = [&](const std::vector<std::int32_t>& of_corner, std::size_t count) {
        return moved_normals(positions_, positions, precision(), polygons_, of_corner, count);
    };
    const Points vertex_normals =
        normals(polygons_.corners, vertices_have_normals_ ? positions.size() : 0);
    const Points face_normals =
        normals(polygon_of_corner, faces_have_normals_ ? polygons_.size() : 0);
    const PlyProperty* const old_quality = quality().empty() ? nullptr : vertices_->find(kQuality);
    const PlyProperty* const before_quality =
        quality().empty() || old_quality ? nullptr : &vertices_->properties.back();

    Patch patch(out, table_.content());
    std::vector<PlyType> types(roles_.size(), PlyType::None);  // of properties that may change
    for (const PlyElement& element : table_.elements()) {
        for (const PlyProperty& property : element.properties) {
            const Role::Kind kind = roles_[property.index].kind;
            const bool is_quality = &property == old_quality;
            if (kind != Role::Coordinate && kind != Role::Normal && !is_quality) continue;
            const bool keeps_floats = property.type == PlyType::Float && !doubles() && !is_quality;
            const PlyType type = keeps_floats ? PlyType::Float : PlyType::Double;
            types[property.index] = type;
            if (type == property.type && !property.is_list()) continue;
            patch.replace(property.type_words, name_of(type));
        }
        if (!before_quality || &element != vertices_) continue;
        std::string line(element.line_end);
        line.append("property double quality").append(element.line_end);
        patch.replace(element.line_end, line);
    }
    table_.for_each_field([&](const PlyElement& element, std::size_t row,
                              const PlyProperty& property, const Words& words) {
        const PlyType type = types[property.index];
        const Role role = roles_[property.index];
        const std::string_view last = words.back();
        if (type != PlyType::None) {
            const double before = table_.number(words[0], property.type);
            double after = before;
            if (&property == old_quality) {
                after = quality()[row];
            } else if (role.kind == Role::Coordinate) {
                after = positions[row][role.axis];
            } else {
                const auto& normal = (&element == faces_ ? face_normals : vertex_normals)[row];
                if (!normal.isZero(0)) after = normal[role.axis];
            }
            const bool has_changed = before != after && !std::isnan(after);
            if (has_changed || type != property.type || property.is_list()) {
                const char* const begin = words[0].data();
                const std::string_view field(begin, last.data() + last.size() - begin);
                patch.replace(field, table_.word(after, type));
            }
        }
        if (&property != before_quality) return;
        const std::string word = table_.word(quality()[row], PlyType::Double);
        patch.replace(last.substr(last.size()), table_.is_text() ? ' ' + word : word);
    });
    patch.finish();
}

}  // namespace

std::unique_ptr<FileDocument> parse_ply(std::string&& content) {
    return std::make_unique<PlyDocument>(std::move(content));
}

void convert_to_ply(std::ostream& out, const FileDocument& source, const Points& positions) {
    const Polygons& polygons = source.polygons();
    std::size_t most_corners = 0;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        most_corners = std::max(most_corners, polygons.corner_count(i));
    }
    // Most programs expect the length of the list in one byte.
    const bool short_lists = most_corners < 256;
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << positions.size() << '\n';
    for (const std::string_view name : kCoordinates) out << "property double " << name << '\n';
    const std::vector<double>& quality = source.quality();
    if (!quality.empty()) out << "property double " << kQuality << '\n';
    out << "element face " << polygons.size_with_triangles() << "\nproperty list "
        << (short_lists ? "uchar" : "int") << " int vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < positions.size(); ++i) {
        out << as_bytes(positions[i]);
        if (!quality.empty()) out << as_bytes(quality[i]);
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (polygons.triangle_count(i) == 0) continue;
        // In the little-endian order the first byte is the short length.
        const auto count = static_cast<std::int32_t>(polygons.corner_count(i));
        out << as_bytes(count).substr(0, short_lists ? 1 : sizeof count);
        out.write(as_bytes(polygons.corners[polygons.first[i]]).data(),
                  count * static_cast<std::streamsize>(sizeof(std::int32_t)));
    }
}

}  // namespace tracked_mcf
