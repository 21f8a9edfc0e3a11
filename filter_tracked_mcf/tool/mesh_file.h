#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A mesh that was read from a file, with all that the file says besides positions.
///
/// Every file is first read whole and checked (documents/), since vcglib's readers trust what they
/// read. vcglib then makes the mesh of it, for polygons to become triangles as they do in MeshLab;
/// ply_to_vcglib.h and vcglib_repairs.h say where it had to be helped.
///
/// Written in its own format, a file is the source with other positions and normals, and nothing is
/// lost: polygons, PLY properties and elements of any kind, cameras, edges, OBJ groups and
/// materials, comments. Converted by vcglib, it keeps what both formats have: colours of vertices
/// and faces, normals (made anew), texture coordinates and names of textures, the last as materials
/// of an OBJ. Polygons then become triangles, edges are left out, and so are texture coordinates of
/// an OFF, which vcglib does not read. An STL has floats and colours of faces, nothing else.
class MeshFile {
public:
    /// Reads PLY, OBJ, OFF or STL, by extension. Throws UnreadableFile.
    explicit MeshFile(const std::filesystem::path& path);
    ~MeshFile();

    /// The vertices in the order of the file, and its faces.
    TriangleMesh triangle_mesh() const;

    /// Which of its triangles the property `name` of a PLY file selects (face_selection.h). Throws
    /// InvalidParameter, for files of other formats too, or InvalidMesh.
    Selection selection_by(const std::string& name) const;

    /// Writes the mesh with the positions of `moved`, which triangle_mesh() made, in the format of
    /// `file`'s extension; PLY and STL are binary. Files that it needs (the material library of an
    /// OBJ) are put beside it. Texture names are made relative to `final_folder`, where the
    /// caller will move the files. Throws UnwritableFile.
    void write(const TriangleMesh& moved, const std::filesystem::path& file,
               const std::filesystem::path& final_folder);

    /// Whether the extension is one of those that can be read and written.
    static bool knows_format_of(const std::filesystem::path& path);

private:
    class Content;
    std::unique_ptr<Content> content_;
};

}  // namespace tracked_mcf
