// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

/// The bit for selected faces and vertices in MeshLab's flags.
constexpr std::int64_t kSelectedFlag = 0x20;

bool is_selecting(const std::string& name, double number) {
    if (name != "flags") return number != 0;
    // Flags are whole numbers of 32 bits; other numbers select nothing.
    const bool is_whole = std::abs(number) <= 4294967295.0 && number == std::trunc(number);
    return is_whole && (static_cast<std::int64_t>(number) & kSelectedFlag) != 0;
}

using NumbersOf = FileDocument::NumbersOf;

std::string property_names(const FileDocument& document, NumbersOf items) {
    std::string list;
    for (const std::string& name : document.property_names(items))
        list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

}  // namespace

MeshFile::MeshFile(const fs::path& path) : path_(path), document_(open_document(path)) {}

TriangleMesh MeshFile::triangle_mesh() const {
    return {document_->positions(), fans(document_->polygons())};
}

bool MeshFile::is_as_large_as(const MeshFile& other) const {
    const bool is_stl = format_of(path_)->convert == convert_to_stl;
    if (is_stl != (format_of(other.path_)->convert == convert_to_stl))
        return triangle_mesh().triangles.size() == other.triangle_mesh().triangles.size();
    return document_->positions().size() == other.document_->positions().size() &&
           document_->polygons().size() == other.document_->polygons().size();
}

std::string MeshFile::size() const {
    return std::to_string(document_->positions().size()) + " vertices and " +
           std::to_string(document_->polygons().size()) + " faces";
}

Selection MeshFile::selection_by(const std::string& name) const {
    const Polygons& polygons = document_->polygons();
    const std::vector<double> of_faces = document_->numbers(NumbersOf::Faces, name);
    const std::vector<double> of_vertices = document_->numbers(NumbersOf::Vertices, name);
    if (of_faces.empty() && of_vertices.empty()) {
        throw InvalidParameter(
            path_.u8string() + " has no number '" + name +
            "' to select by; its faces have: " + property_names(*document_, NumbersOf::Faces) +
            "; its vertices: " + property_names(*document_, NumbersOf::Vertices) + ".");
    }
    const auto is_selected = [&](std::size_t polygon) {
        if (!of_faces.empty()) return is_selecting(name, of_faces[polygon]);
        const std::int32_t* const corners = polygons.corners.data() + polygons.first[polygon];
        return std::all_of(corners, corners + polygons.corner_count(polygon), [&](auto vertex) {
            return is_selecting(name, of_vertices[static_cast<std::size_t>(vertex)]);
        });
    };
    Selection selection;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        selection.insert(selection.end(), polygons.triangle_count(i), is_selected(i) ? 1 : 0);
    }
    if (std::count(selection.begin(), selection.end(), 1) == 0) {
        throw InvalidMesh("No face of " + path_.u8string() + " is selected by '" + name +
                          "' of its " + (of_faces.empty() ? "vertices" : "faces") +
                          "; select some.");
    }
    return selection;
}

std::vector<double> MeshFile::numbers_by(const std::string& name) const {
    std::vector<double> numbers = document_->numbers(NumbersOf::Vertices, name);
    if (numbers.empty()) {
        throw InvalidParameter("The vertices of " + path_.u8string() + " have no number '" + name +
                               "'; they have: " + property_names(*document_, NumbersOf::Vertices) +
                               ".");
    }
    return numbers;
}

void MeshFile::set_quality(const std::vector<double>& quality) {
    document_->set_quality(quality);
}

void MeshFile::write_doubles() {
    document_->write_doubles();
}

bool MeshFile::writes_floats(const fs::path& file) const {
    const Format* const format = format_of(file);
    return format == format_of(path_) ? document_->writes_floats()
                                      : format->convert == convert_to_stl;
}

void MeshFile::write(const TriangleMesh& moved, std::ostream& out, const fs::path& file) const {
    const Format* const format = format_of(file);
    if (format == format_of(path_))
        document_->write(out, moved.positions);
    else
        format->convert(out, *document_, moved.positions);
}

std::string MeshFile::conversion_warning(const fs::path& file) const {
    const Format *const from = format_of(path_), *const to = format_of(file);
    if (from == to) return {};
    std::vector<std::string> losses = document_->extras();
    const Polygons& polygons = document_->polygons();
    if (polygons.size_with_triangles() < polygons.size()) {
        losses.emplace_back("faces of fewer than 3 corners");
    }
    if (losses.empty()) return {};
    std::string list;
    for (const std::string& loss : losses) list += (list.empty() ? "" : "; ") + loss;
    return file.u8string() + " does not keep everything of " + path_.u8string() +
           ". Left out: " + list + ". To keep it, write a " + from->extension + " file.";
}

}  // namespace tracked_mcf
