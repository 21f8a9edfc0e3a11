#pragma once

#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/documents/ply_table.h"

namespace tracked_mcf {

/// A PLY file with a surface: vertices with x, y, z and faces with vertex_indices.
class PlyDocument : public MeshDocument {
public:
    /// Throws UnreadableFile where something of a surface is missing or out of range.
    explicit PlyDocument(PlyTable table);

    const Points& positions() const override { return positions_; }
    const Polygons& polygons() const override { return polygons_; }
    bool has_normals() const override;

    /// Binary, in this machine's byte order (which PLY readers expect to be the little-endian one).
    void write(std::ostream& out, const Points& positions,
               const FolderChange& change) const override;

    const PlyElement& vertices() const { return *table_.find("vertex"); }
    const PlyElement& faces() const { return *table_.find("face"); }

    /// Names of textures, from comments.
    std::vector<std::string> textures() const;

private:
    void write_header(std::ostream& out, const FolderChange& change) const;
    Points vertex_normals(const Points& positions) const;
    Points face_normals(const Points& positions) const;

    PlyTable table_;
    Points positions_;
    Polygons polygons_;
};

}  // namespace tracked_mcf
