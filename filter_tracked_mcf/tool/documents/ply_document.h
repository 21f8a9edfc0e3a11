// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/tool/documents/file_document.h"
#include "filter_tracked_mcf/tool/documents/ply_table.h"

namespace tracked_mcf {

/// A PLY file with a surface: vertices with x, y, z and faces or tristrips with vertex_indices. The
/// triangles of strips follow the faces.
class PlyDocument : public FileDocument {
public:
    /// Throws UnreadableFile if a part of a surface is missing or out of range.
    explicit PlyDocument(std::string content);

    bool writes_floats() const override;
    std::vector<Color> vertex_colors() const override;
    std::vector<std::string> extras() const override;

    std::vector<double> numbers(NumbersOf items, const std::string& name) const override;
    std::vector<std::string> property_names(NumbersOf items) const override;

    /// Writes a text or binary file, as the file was.
    void write(std::ostream& out, const Points& positions) const override;

private:
    /// What a property means. The axis is that of a point, or the channel of a colour.
    struct Role {
        enum Kind { None, Coordinate, Normal, Channel, Corners, Strips } kind = None;
        int axis = 0;
    };

    bool set_roles(const PlyElement* element, Role::Kind kind,
                   const std::array<std::string_view, 3>& names);
    void read();

    PlyTable table_;
    const PlyElement *vertices_, *faces_;  ///< faces_ is null if there are only strips
    std::vector<Role> roles_;              ///< by PlyProperty::index
    bool vertices_have_normals_ = false, faces_have_normals_ = false;
};

}  // namespace tracked_mcf
