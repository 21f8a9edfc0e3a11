// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/tool/documents/file_document.h"
#include "filter_tracked_mcf/tool/documents/ply_table.h"

namespace tracked_mcf {

/// A PLY file with a surface: vertices with x, y, z and faces with vertex_indices.
class PlyDocument : public FileDocument {
public:
    /// Throws UnreadableFile if a part of a surface is missing or out of range.
    explicit PlyDocument(PlyTable table);

    bool writes_floats() const override;
    std::vector<Color> vertex_colors() const override;
    std::vector<std::string> extras() const override;

    std::vector<double> numbers(NumbersOf items, const std::string& name) const override;
    std::vector<std::string> property_names(NumbersOf items) const override;

    /// Writes a binary file in this machine's byte order, which must be little-endian.
    void write(std::ostream& out, const Points& positions) const override;

    const PlyElement& vertices() const { return *table_.find("vertex"); }
    const PlyElement& faces() const { return *table_.find("face"); }

private:
    const PlyElement& element(NumbersOf items) const {
        return items == NumbersOf::Faces ? faces() : vertices();
    }

    PlyTable table_;
};

}  // namespace tracked_mcf
