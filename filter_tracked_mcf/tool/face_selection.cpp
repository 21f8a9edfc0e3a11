#include "filter_tracked_mcf/tool/face_selection.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

using Marks = std::vector<std::uint8_t>;

/// vcglib's SELECTED among the flags that MeshLab writes.
constexpr std::int64_t kSelectedFlag = 0x20;

bool has_number(const PlyElement& element, const std::string& name) {
    const PlyProperty* const property = element.find(name);
    return property && !property->is_list();
}

bool marks(const std::string& name, double number) {
    if (name != "flags") return number != 0;
    // Other numbers than whole ones of 32 bits are no flags.
    const bool is_whole = std::abs(number) <= 4294967295.0 && number == std::trunc(number);
    return is_whole && (static_cast<std::int64_t>(number) & kSelectedFlag) != 0;
}

Marks marked_rows(const PlyElement& element, const std::string& name) {
    const PlyProperty* const wanted = element.find(name);
    Marks result(element.count, 0);
    element.for_each_field(
        [&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
            if (&property != wanted) return;
            result[row] = marks(name, number_at(bytes.data(), property.type)) ? 1 : 0;
        });
    return result;
}

/// Of every polygon, whether all of its corners are marked vertices.
Marks with_all_corners(const Polygons& polygons, const Marks& vertices) {
    Marks result(polygons.size(), 1);
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        for (std::size_t corner = polygons.first[i]; corner < polygons.first[i + 1]; ++corner) {
            if (vertices[static_cast<std::size_t>(polygons.corners[corner])] == 0) result[i] = 0;
        }
    }
    return result;
}

Selection triangles_of(const Polygons& polygons, const Marks& selected) {
    Selection result;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        result.insert(result.end(), polygons.corner_count(i) - 2, selected[i]);
    }
    return result;
}

std::string numbers_of(const PlyElement& element) {
    std::string list;
    for (const PlyProperty& property : element.properties) {
        if (!property.is_list()) list += (list.empty() ? "" : ", ") + property.name;
    }
    return list.empty() ? "none" : list;
}

}  // namespace

Selection selected_triangles(const PlyDocument& document, const std::string& name,
                             const std::string& file) {
    const Polygons& polygons = document.polygons();
    const bool by_faces = has_number(document.faces(), name);
    if (!by_faces && !has_number(document.vertices(), name)) {
        throw InvalidParameter(file + " has no number '" + name +
                               "' to select by; its faces have: " + numbers_of(document.faces()) +
                               "; its vertices: " + numbers_of(document.vertices()) + ".");
    }
    const Marks selected = by_faces
                               ? marked_rows(document.faces(), name)
                               : with_all_corners(polygons, marked_rows(document.vertices(), name));
    if (std::all_of(selected.begin(), selected.end(), [](auto mark) { return mark == 0; })) {
        throw InvalidMesh("No face of " + file + " is selected by '" + name + "' of its " +
                          (by_faces ? "faces" : "vertices") +
                          "; select some, or leave --selected out to smooth the whole mesh.");
    }
    return triangles_of(polygons, selected);
}

}  // namespace tracked_mcf
